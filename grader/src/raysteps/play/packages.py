"""What is kept in build/play, or in a folder that clones share: the packages of others that the page needs, from the
npm registry, pinned by their hashes and loaded down once, and what the page is made of."""

import base64
import hashlib
import http.client
import io
import json
import os
import re
import shutil
import tarfile
import tempfile
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from raysteps.common.errors import UsageError, reason
from raysteps.common.files import write_bytes, write_json
from raysteps.common.text import shorten

REGISTRY = "https://registry.npmjs.org"
_SECONDS = 60  # without a byte
_PIECE = 1 << 18
_MAX_BYTES = 200 << 20


@dataclass(frozen=True)
class Package:
    """One version. `sha512` is what the registry calls its integrity."""

    name: str
    version: str
    sha512: str

    @property
    def address(self) -> str:
        """Behind the address of a registry."""
        return f"{self.name}/-/{self.name.rpartition('/')[2]}-{self.version}.tgz"

    @property
    def folder(self) -> str:
        """Its name in the cache."""
        return f"{self.name.removeprefix('@').replace('/', '-')}-{self.version}"


CLANG = Package(
    "@yowasp/clang",
    "22.0.0-git20542-10",
    "V31/z9GrJECKeACTDUyvg2llbEUiFi3bxtL5HSg7H/6sydSxdI/AoVAD9F5ozrfLjotWl0B9rghR87m+DUM/zg==",
)
# The marks of what the page takes from it: the compiler, and headers and libraries.
CLANG_WASM = "1dbd9fbfef8c76591093baa47e26b98e5da7d44cb265d8faef2221c496ff28da"
CLANG_SYSTEM = "fb6e00a1f3e12849963d5dfe6a663ae92c2d8c9da619a9755c5198eb86f581d7"
EDITOR = (
    Package(
        "@codemirror/autocomplete",
        "6.20.4",
        "yF8RhOf2SXlg00+qtupzLhrglcas61boqaONiNcbPIebHCpJocpqTBA6dyrtUrQO47hqyTdeob/3XnYilT7TaQ==",
    ),
    Package(
        "@codemirror/commands",
        "6.11.1",
        "O/4hG3SC1YwcmQ0d2UVNDs+AsaNWd1iHVxbTeEBuqH+6bExAiPK3iS/BvpY6rZGURALv4ZD3sIgcCmRvw3ehBg==",
    ),
    Package(
        "@codemirror/lang-cpp",
        "6.0.3",
        "URM26M3vunFFn9/sm6rzqrBzDgfWuDixp85uTY49wKudToc2jTHUrKIGGKs+QWND+YLofNNZpxcNGRynFJfvgA==",
    ),
    Package(
        "@codemirror/language",
        "6.13.1",
        "zfvU2r3TyylQLMj/te+5CnQ0rSqZi8B1oTCBbQkagcLW4Xc6imab6qN+pEJhsuNOLaJqiRyBXp9UhWA1DhVvDw==",
    ),
    Package(
        "@codemirror/lint",
        "6.9.8",
        "qNvtcE73xUto/D1RvtgSRI4A1Hg8ekxlvtZpjHpdpisLBnhyu82EUEJMEgaxkjuQCA8vqnrylENWKOsEDCOHcw==",
    ),
    Package(
        "@codemirror/search",
        "6.7.2",
        "gUYkYhT2+n/+VGZ+8EzE5WFkYZUZYm1VOKDudIsNqh42uRVQJ0a6Yss9sdKT3MeOYfuL1N6AZA57oza0Oyr0LA==",
    ),
    Package(
        "@codemirror/state",
        "6.7.6",
        "kAz+AncRtKuIknedxT1bq4XwXv4UowhbkHU1myPrtVb/jZtImWuV5BXzv5vK6i3kYACsdiZiQKFQQ5Mq7elW8w==",
    ),
    Package(
        "@codemirror/streamparser",
        "6.0.0",
        "JTFPF6xrfjt0mnfGPgzcLiMwYmvIyNaoizp8BYzv8FE8KrT6GBGDZ190rtt+O7Wke3gG/MFHyiY9YGNeimof4w==",
    ),
    Package(
        "@codemirror/view",
        "6.43.15",
        "HHsfpqFeHyXLs983pSRe38Xajs0vFWZQ2BuX0m7Ki8w3jZ5iD8cuR3lBz2/5/X53Dhf32SBHKh6rtSTB6tKeGw==",
    ),
    Package(
        "@lezer/common",
        "1.5.5",
        "Pw7PVCndruF1pb3ebCxpSVpkMHSDjwRCLcTRw+RizUKco5QbWylwq2g4lnG/RYN7yTTQDXE9F77MwtkAyphrjg==",
    ),
    Package(
        "@lezer/cpp",
        "1.1.6",
        "vh9gWWJOXFVY8HBHK3Twzq8MgwG2iN4GSyzBP9sCGTe37P15x2R14VaBQk0VA0ezTRN1KHYBBsHhvpGZ2Xy/pA==",
    ),
    Package(
        "@lezer/highlight",
        "1.2.5",
        "O1GMVKgtf5YspFaRzpmqkVgMtIk2HG9uMAbH6wdAIdNh3TVzCsch/+cRi+6l2//UGDKe6NB9BW3cvuR5ezMQ0w==",
    ),
    Package(
        "@lezer/lr",
        "1.4.12",
        "On9HU4oMMiHPMkQDgoTnGahjgG5n/MkN38CgG77sMraKLL+3JBbeQNi1FcCXV9QRqwF9/BUXP3caHyJC1fBOTQ==",
    ),
    Package(
        "@marijn/find-cluster-break",
        "1.0.4",
        "Wy0V7+SGUjnF9/TkiM1hKVDPj7jKXduPNboMVtHTA8dySMURWqfg/JZ9E2Sq8JgSJmkl7k7Qe9FLeMSrSraWmQ==",
    ),
    Package(
        "crelt",
        "1.0.7",
        "aK6BbWfhf4U/wCcLHKPJl/xa6VkVstRaPywWtMKGwuOLc/wZTyQYuoxgvZnNsBvv7Kg3YTBQYYBCggcviQczuA==",
    ),
    Package(
        "style-mod",
        "4.1.5",
        "WQ2llCZa9sZSkJA+aOwpg5DkfbAXFKGh//t3MRTBeruFiSBC+GXUmbBzrw3bXyboCWAbtCW9InDfBsXrRD/rAg==",
    ),
    Package(
        "w3c-keyname",
        "2.2.8",
        "dpojBhNsCNN7T82Tm7k26A6G9ML3NkhDsnw9n/eoxSRlVBB4CEtIQ/KTCLI2Fwf3ataSXRhYFkQi3SlnFwPvPQ==",
    ),
)


@dataclass(frozen=True)
class Header:
    """One file, where its makers publish it."""

    folder: str  # its name in the cache
    address: str
    sha512: str
    instead: str  # what helps whom the address does not


CATCH2 = Header(  # the last of version 2, for machines that have version 3 without its sources
    "catch2-2.13.10",
    "https://raw.githubusercontent.com/catchorg/Catch2/v2.13.10/single_include/catch2/catch.hpp",
    "t92KzOLTLob1NWx7fpanLGrssFKa8pp6uFuN+xZJ1RC8/hF/V2kbdXg8qQ/SHDR/ZMnPbUuZbWhvgvCBhA6Jyw==",
    "Where Catch2 of version 2 is installed, its own header is taken",
)


def registry_of(words: str | None) -> str:
    """The one that was named, else the one that npm itself would ask."""
    named = os.environ.get("npm_config_registry")  # noqa: SIM112 - npm writes it so
    return (words or named or REGISTRY).rstrip("/")


def _loaded(address: str, heard: Callable[[int], None]) -> bytes:
    request = urllib.request.Request(address, headers={"User-Agent": "raysteps"})  # noqa: S310 - http or https
    with urllib.request.urlopen(request, timeout=_SECONDS) as answer:  # noqa: S310
        data = io.BytesIO()
        while piece := answer.read(_PIECE):
            data.write(piece)
            heard(data.tell())
            if data.tell() > _MAX_BYTES:
                raise OSError("it is larger than any package that is asked for")
        length = answer.headers.get("Content-Length")
        if length is not None and length.strip() != str(data.tell()):
            raise OSError(f"{data.tell()} bytes came, {shorten(length, 20)} were announced")
        return data.getvalue()


def extract(archive: tarfile.TarFile, folder: Path) -> None:
    """All of an archive whose bytes are known. Python 3.11 has filters from 3.11.4 on, and Debian 12 an older one."""
    if hasattr(tarfile, "data_filter"):
        archive.extractall(folder, filter="data")
    else:
        archive.extractall(folder)  # noqa: S202


def _unpack(data: bytes, folder: Path) -> None:
    """All names in a package begin with one folder."""
    with tarfile.open(fileobj=io.BytesIO(data), mode="r:gz") as archive:
        extract(archive, folder)


def _checked(address: str, sha512: str, instead: str, say: Callable[[str], None]) -> bytes:
    """What comes from there is not believed: it has the hash that the kit knows, or it is not used. `instead` says
    what helps where this address does not."""
    try:
        data = _loaded(address, lambda done: say(f"loading down {address.rpartition('/')[2]}, {done / 1e6:.1f} MB"))
    except (OSError, http.client.HTTPException) as error:
        inner = getattr(error, "reason", None)  # of an error of urllib
        why = reason(inner if isinstance(inner, OSError) else error)
        raise UsageError(
            f"{address}: cannot be loaded down: {why}. Is there a network connection? {instead}"
        ) from error
    found = base64.b64encode(hashlib.sha512(data).digest()).decode("ascii")
    if found != sha512:
        raise UsageError(
            f"{address}: is not what the kit knows: its SHA-512 is {found[:12]}..., expected {sha512[:12]}.... "
            f"Try again. {instead}"
        )
    return data


@contextmanager
def new_folder(folder: Path) -> Iterator[Path]:
    """A place to make the folder in, under any name; it gets its own when it is whole, unless another command was
    quicker."""
    folder.parent.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix=".new-", dir=folder.parent, ignore_cleanup_errors=True) as name:
        yield Path(name)
        (top,) = Path(name).iterdir()
        try:
            top.rename(folder)
        except OSError:
            if not folder.is_dir():
                raise


def fetch(package: Package, cache: Path, registry: str, say: Callable[[str], None] = lambda text: None) -> Path:
    """The folder of the package's files; loaded down from the registry where the cache lacks it."""
    folder = cache / package.folder
    if folder.is_dir():
        return folder
    address = f"{registry}/{package.address}"
    if not re.match(r"https?://[^/]", address):
        raise UsageError(f"{registry}: expected a registry's address, such as {REGISTRY}")
    data = _checked(address, package.sha512, "--registry names a mirror of npm's", say)
    with new_folder(folder) as new:
        _unpack(data, new)
    return folder


def fetch_header(header: Header, target: Path, say: Callable[[str], None] = lambda text: None) -> None:
    """Writes the file."""
    write_bytes(target, _checked(header.address, header.sha512, header.instead, say))


# What this page and the last one that was another are made of stays, for who goes back. Objects of a few more stay: a
# whole kit makes its own page, that of a course with other parts, that of a release, and the figures of the site.

_RECORD = "used.json"
_PAGES, _PAGES_OF_OBJECTS = 2, 4


def clear(cache: Path, used: Iterable[Path]) -> None:
    """Removes the rest from the folders in which `used` lie, folders or files; these are named without their ending,
    and all of such a name belong together."""
    now = sorted({path.relative_to(cache).as_posix() for path in used})
    record = cache / _RECORD
    lists = json.loads(record.read_text("utf-8")) if record.is_file() else []
    if lists[:1] != [now]:
        lists = [now, *(some for some in lists if some != now)][:_PAGES_OF_OBJECTS]
        write_json(record, lists)
    objects = (name for some in lists for name in some if name.startswith("objects/"))
    kept = {record.stem, *objects, *(name for some in lists[:_PAGES] for name in some)}
    for folder in {(cache / name).parent for name in kept}:
        for path in folder.iterdir():
            name = path.relative_to(cache).as_posix()
            is_kept = any(f"{name}.".startswith(f"{one}.") or one.startswith(f"{name}/") for one in kept)
            if is_kept or path.name.startswith("."):  # somebody is writing it
                continue
            with suppress(OSError):  # on Windows somebody may have it open
                shutil.rmtree(path) if path.is_dir() else path.unlink()


# The compiler, and what it made, where several clones share it: kept until none has used it for a while.

CACHE_VARIABLE = "RAYSTEPS_PLAY_CACHE"
_DAYS = 14


def cache_of(own: Path) -> Path:
    """Where they lie: in the folder of one's own, or where the variable says."""
    return Path(os.environ.get(CACHE_VARIABLE) or own)


def clear_by_age(cache: Path, used: Iterable[Path]) -> None:
    """Removes objects that were not among those in use for two weeks. Others may be using any of the rest."""
    for place in used:
        for path in place.parent.glob(f"{place.name}.*"):
            os.utime(path)
    oldest = time.time() - _DAYS * 24 * 3600
    for path in (cache / "objects").glob("*"):
        with suppress(OSError):
            if path.stat().st_mtime < oldest:
                path.unlink()


def content_mark(content: Mapping[str, bytes]) -> str:
    """Changes with every byte of these files, and with their paths."""
    digest = hashlib.sha256()
    for path, data in sorted(content.items()):
        digest.update(f"{path}\0{len(data)}\0".encode() + data)
    return digest.hexdigest()


def written_once(cache: Path, name: str, content: Mapping[str, bytes]) -> Path:
    """A folder of these files, by their paths. Its name changes with every byte, so it never has to be changed."""
    folder = cache / f"{name}-{content_mark(content)[:12]}"
    if not folder.is_dir():
        with new_folder(folder) as new:
            whole = new / folder.name
            whole.mkdir()
            for path, data in content.items():
                (whole / path).parent.mkdir(parents=True, exist_ok=True)
                (whole / path).write_bytes(data)
    return folder
