unpack() { # the kit, to the one place where it is built and used: programs remember where they were built
    mkdir -p "$kit" && chmod 700 "$kit" && tar -xf "$here/kit.tar" --no-same-owner --strip-components=1 -C "$kit"
}
