"""Packages come from a registry that is named, once, and only if they are what the kit knows."""

import base64
import hashlib
import http.server
import io
import tarfile
import threading
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import cast

import pytest

from raysteps.common.errors import UsageError
from raysteps.play.packages import (
    CATCH2,
    CLANG,
    EDITOR,
    REGISTRY,
    Header,
    Package,
    extract,
    fetch,
    fetch_header,
    registry_of,
)

pytestmark = pytest.mark.portable


def _tarball(content: bytes = b"export const one = 1;\n") -> bytes:
    data = io.BytesIO()
    with tarfile.open(fileobj=data, mode="w:gz") as archive:
        info = tarfile.TarInfo("package/dist/index.js")
        info.size = len(content)
        archive.addfile(info, io.BytesIO(content))
    return data.getvalue()


_DATA = _tarball()
_PACKAGE = Package("@some/editor", "1.2.3", base64.b64encode(hashlib.sha512(_DATA).digest()).decode())


class _Registry(http.server.ThreadingHTTPServer):
    """Gives what it has; `cut` bytes of each answer do not come, or else its length is told as `length`."""

    def __init__(self) -> None:
        super().__init__(("127.0.0.1", 0), _Answer)
        self.files: dict[str, bytes] = {"/npm/@some/editor/-/editor-1.2.3.tgz": _DATA}
        self.cut = 0
        self.length: str | None = None
        self.asked: list[str] = []
        threading.Thread(target=self.serve_forever, args=(0.05,), daemon=True).start()

    @property
    def address(self) -> str:
        return f"http://127.0.0.1:{self.server_address[1]}/npm"


class _Answer(http.server.BaseHTTPRequestHandler):
    server: _Registry

    def do_GET(self) -> None:
        self.server.asked.append(self.path)
        data = self.server.files.get(self.path)
        self.send_response(200 if data is not None else 404)
        self.send_header("Content-Length", self.server.length or str(len(data or b"")))
        self.end_headers()
        self.wfile.write((data or b"")[: len(data or b"") - self.server.cut])

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        pass


@pytest.fixture
def registry() -> Iterator[_Registry]:
    found = _Registry()
    yield found
    found.shutdown()
    found.server_close()


class _OlderArchive:
    """As Python 3.11.2 has it, and with that Debian 12."""

    def __init__(self) -> None:
        self.unpacked: list[Path] = []

    def extractall(self, path: Path) -> None:
        self.unpacked.append(path)


def test_an_older_python_unpacks_as_well(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delattr(tarfile, "data_filter", raising=False)
    archive = _OlderArchive()
    extract(cast(tarfile.TarFile, archive), tmp_path)
    assert archive.unpacked == [tmp_path]


def test_a_package_is_loaded_down_once(registry: _Registry, tmp_path: Path) -> None:
    said: list[str] = []
    folder = fetch(_PACKAGE, tmp_path / "cache", registry.address, said.append)
    assert (folder / "dist" / "index.js").read_bytes() == b"export const one = 1;\n"
    assert said
    assert "editor-1.2.3.tgz" in said[0]
    assert fetch(_PACKAGE, tmp_path / "cache", "http://127.0.0.1:1") == folder
    assert registry.asked == ["/npm/@some/editor/-/editor-1.2.3.tgz"]


def test_of_two_commands_at_once_one_is_quicker(registry: _Registry, tmp_path: Path) -> None:
    def meanwhile(_text: str) -> None:
        (tmp_path / _PACKAGE.folder).mkdir(exist_ok=True)
        (tmp_path / _PACKAGE.folder / "of-the-other").touch()

    assert (fetch(_PACKAGE, tmp_path, registry.address, meanwhile) / "of-the-other").is_file()
    assert [path.name for path in tmp_path.iterdir()] == [_PACKAGE.folder]


def test_another_package_than_the_one_that_is_known_is_not_unpacked(registry: _Registry, tmp_path: Path) -> None:
    registry.files = dict.fromkeys(registry.files, _tarball(b"export const two = 2;\n"))
    with pytest.raises(UsageError, match="is not what the kit knows"):
        fetch(_PACKAGE, tmp_path / "cache", registry.address)
    assert not (tmp_path / "cache").exists()


def test_half_a_package_is_none(registry: _Registry, tmp_path: Path) -> None:
    registry.cut = 10
    with pytest.raises(UsageError, match="cannot be loaded down"):
        fetch(_PACKAGE, tmp_path / "cache", registry.address)
    assert not (tmp_path / "cache").exists()
    registry.cut = 0
    registry.length = "many"
    with pytest.raises(UsageError, match=r"[0-9]+ bytes came, many were announced"):
        fetch(_PACKAGE, tmp_path / "cache", registry.address)
    registry.length = None
    assert fetch(_PACKAGE, tmp_path / "cache", registry.address).is_dir()


def test_where_there_is_no_package_the_address_is_said(registry: _Registry, tmp_path: Path) -> None:
    registry.files.clear()
    with pytest.raises(UsageError, match=r"/npm/@some/editor/-/editor-1\.2\.3\.tgz: cannot be loaded down.*--registry"):
        fetch(_PACKAGE, tmp_path, registry.address)
    with pytest.raises(UsageError, match="expected a registry's address"):
        fetch(_PACKAGE, tmp_path, "file:///etc")


def test_one_header_is_checked_as_well(registry: _Registry, tmp_path: Path) -> None:
    header = Header("catch2-2", f"{registry.address}/{_PACKAGE.address}", _PACKAGE.sha512, "Or install it")
    fetch_header(header, tmp_path / "catch2" / "catch.hpp")
    assert (tmp_path / "catch2" / "catch.hpp").read_bytes() == _DATA
    with pytest.raises(UsageError, match="is not what the kit knows"):
        fetch_header(replace(header, sha512=CATCH2.sha512), tmp_path / "other.hpp")
    assert not (tmp_path / "other.hpp").exists()
    with pytest.raises(UsageError, match=r"cannot be loaded down.*Or install it") as told:
        fetch_header(replace(header, address=f"{registry.address}/none"), tmp_path / "other.hpp")
    assert "--registry" not in str(told.value)


def test_the_registry_is_the_one_that_was_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("npm_config_registry", raising=False)
    assert registry_of(None) == REGISTRY
    monkeypatch.setenv("npm_config_registry", "https://mirror.example/npm/")
    assert registry_of(None) == "https://mirror.example/npm"
    assert registry_of("https://other.example") == "https://other.example"


def test_every_package_is_pinned() -> None:
    for package in (CLANG, *EDITOR, CATCH2):
        assert len(base64.b64decode(package.sha512)) == 64
