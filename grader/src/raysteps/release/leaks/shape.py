"""What a file of a release may be: text, or a PNG picture that is nothing else."""

import zlib
from collections.abc import Iterator

PNG = b"\x89PNG\r\n\x1a\n"
# The first bytes of what somebody may leave behind, for better words. What is not known is refused just as well.
_COMPILED = (
    b"\x7fELF", b"!<arch>\n", b"!<thin>\n", b"\xcf\xfa\xed\xfe", b"\xce\xfa\xed\xfe", b"\xca\xfe\xba\xbe", b"\x64\x86",
    b"\x4c\x01", b"\x64\xaa", b"\0\0\xff\xff", b"BC\xc0\xde", b"\0asm", b"gpch", b"MZ",
)  # fmt: skip
_CHUNKS = {
    b"IHDR", b"PLTE", b"IDAT", b"IEND", b"tRNS", b"gAMA", b"cHRM", b"sRGB", b"sBIT", b"bKGD", b"pHYs", b"tIME", b"tEXt",
    b"zTXt", b"iTXt",
}  # fmt: skip
_NOT_OF_TEXT = bytes(set(range(32)) - set(b"\t\n\r\f"))


def png_chunks(data: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Kind and content of each, up to the end or to the first that is cut off."""
    at, kind = len(PNG), b""
    while at + 12 <= len(data) and kind != b"IEND":
        size, kind = int.from_bytes(data[at : at + 4], "big"), data[at + 4 : at + 8]
        yield kind, data[at + 8 : at + 8 + size]
        at += 12 + size


def _is_whole_picture(data: bytes) -> bool:
    """Chunks of known kinds with right sums up to the last byte, and pixels that are pixels."""
    made, pixels, kinds = [PNG], b"", []
    for kind, body in png_chunks(data):
        made += [len(body).to_bytes(4, "big"), kind, body, zlib.crc32(kind + body).to_bytes(4, "big")]
        kinds.append(kind)
        pixels += body if kind == b"IDAT" else b""
    if b"".join(made) != data or kinds[:1] != [b"IHDR"] or kinds[-1] != b"IEND" or not _CHUNKS.issuperset(kinds):
        return False
    unpacking = zlib.decompressobj()
    try:
        unpacking.decompress(pixels)
    except zlib.error:
        return False
    return unpacking.eof and not unpacking.unused_data


def _is_text(data: bytes) -> bool:
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return not data.translate(None, delete=bytes(set(range(256)) - set(_NOT_OF_TEXT)))


def strange(data: bytes) -> str | None:
    """What is wrong with a file of another shape."""
    if data.startswith(PNG):
        return None if _is_whole_picture(data) else "a PNG that is damaged, or that holds more than a picture"
    if data.startswith(_COMPILED):
        return "something compiled, which a release has none of"
    return None if _is_text(data) else "neither UTF-8 text nor a PNG picture, and a release has nothing else"
