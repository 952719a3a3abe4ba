"""The compiler of the page, run here by the same bytes: what the page is given was made by what it compiles with."""

import shlex
import tarfile
import tempfile
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import version
from pathlib import Path
from typing import Any

from raysteps.common.errors import GraderFault
from raysteps.common.files import file_lock, write_bytes
from raysteps.common.text import shorten
from raysteps.play.packages import extract, new_folder

# Exceptions are the engine's own; floats are as exact as everywhere in the kit, so that pictures are the same.
_FLAGS = ("-std=c++20", "-DNDEBUG", "-ffp-contract=off", "-fwasm-exceptions", "-mllvm", "-wasm-use-legacy-eh=false")
# It was made with assertions, and then checks and names all that it makes, for those who work on the compiler.
_UNCHECKED = ("-fdiscard-value-names", "-Xclang", "-disable-llvm-verifier")
# A stack as everywhere else, below everything else: one that overflows runs into nothing.
_STACK = 8 << 20
_MEMORY = 1 << 30
_LINK_FLAGS = ("-fwasm-exceptions", f"-Wl,-z,stack-size={_STACK}", "-Wl,--stack-first", f"-Wl,--max-memory={_MEMORY}")
INPUT, OUTPUT = "/work/input", "/work/output"  # in a command, where files are named


@dataclass(frozen=True)
class ProgramResult:
    """How a program ended, and what it printed."""

    code: int
    stdout: str
    stderr: str


def commands_of(said: str) -> list[list[str]]:
    """What a driver would start, as it prints it for -###."""
    return [shlex.split(line) for line in said.splitlines() if line.startswith(' "')]


class WebClang:
    """Runs LLVM's programs, and what they make, by wasmtime. `places` are folders by the names that programs know them
    by."""

    def __init__(self, package: Path, cache: Path, say: Callable[[str], None] = lambda text: None) -> None:
        self.wasm = package / "gen" / "llvm.core.wasm"
        self._package = package
        self.cache = cache
        self._say = say
        self._ready: dict[Path, Any] = {}

    @property
    def used(self) -> list[Path]:
        """What it keeps in the cache."""
        return [self.system, self._for_this_machine]

    @property
    def _for_this_machine(self) -> Path:
        return self.cache / f"{self._package.name}-wasmtime-{version('wasmtime')}"

    @cached_property
    def system(self) -> Path:
        """Headers and libraries, which programs know as /usr."""
        folder = self.cache / f"{self._package.name}-system"
        if not folder.is_dir():
            with new_folder(folder) as new, tarfile.open(self._package / "gen" / "llvm-resources.tar") as archive:
                extract(archive, new / folder.name)
        return folder

    @cached_property
    def _engine(self) -> Any:
        from wasmtime import Config, Engine

        config = Config()
        config.cranelift_opt_level = "none"  # as fast as it needs to be, and ready in half of the time
        config.wasm_exceptions = True
        return Engine(config)

    @cached_property
    def _llvm(self) -> Any:
        """Compiled for this machine once; that takes most of a minute."""
        import wasmtime

        place = self._for_this_machine
        path = place.with_name(f"{place.name}.bin")
        with file_lock(place.with_name(f"{place.name}.lock"), lambda: self._say("waiting for another command")):
            if path.is_file():
                try:
                    return wasmtime.Module.deserialize_file(self._engine, str(path))
                except wasmtime.WasmtimeError:
                    pass  # of another machine
            self._say("getting the compiler ready for this machine (once, about a minute)")
            module = wasmtime.Module.from_file(self._engine, str(self.wasm))
            write_bytes(path, bytes(module.serialize()))
            return module

    def llvm(self, words: Sequence[str], places: Mapping[str, Path]) -> ProgramResult:
        """One of its programs: clang++, wasm-ld, ar."""
        return self._run(self._llvm, words, places)

    def program(self, wasm: Path, words: Sequence[str], places: Mapping[str, Path]) -> ProgramResult:
        """One that was linked. It stays ready: some draw many pictures."""
        from wasmtime import Module

        if wasm not in self._ready:
            self._ready[wasm] = Module.from_file(self._engine, str(wasm))
        return self._run(self._ready[wasm], words, places)

    def _run(self, module: Any, words: Sequence[str], places: Mapping[str, Path]) -> ProgramResult:
        from wasmtime import ExitTrap, FuncType, Linker, Store, Trap, ValType, WasiConfig

        with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
            said = [Path(folder) / "stdout", Path(folder) / "stderr"]
            wasi = WasiConfig()
            wasi.argv = list(words)
            wasi.stdout_file, wasi.stderr_file = map(str, said)
            for name, path in places.items():
                wasi.preopen_dir(str(path), name)
            store = Store(self._engine)
            store.set_wasi(wasi)
            linker = Linker(self._engine)
            linker.define_wasi()
            linker.define_func("page", "show_tile", FuncType([ValType.i32()] * 5, []), lambda *where: None)
            code, fault = 0, ""
            try:
                start: Any = linker.instantiate(store, module).exports(store)["_start"]
                start(store)
            except ExitTrap as end:
                code = end.code
            except Trap as trap:
                code, fault = -1, str(trap)
            del store  # which closes the files
            stdout, stderr = (path.read_text("utf-8", "replace") if path.is_file() else "" for path in said)
            return ProgramResult(code, stdout, stderr + fault)

    def make(self, words: Sequence[str], places: Mapping[str, Path]) -> None:
        """Runs a program that has no reason to fail."""
        said = self.llvm(words, places)
        if said.code != 0:
            raise GraderFault(f"the page's compiler fails: {shorten(said.stderr or said.stdout, 4000)}")

    def _command(self, words: Sequence[str]) -> list[str]:
        """The one that a driver would start, without what only tells where it was started."""
        with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
            (Path(folder) / Path(INPUT).name).touch()
            said = self.llvm(["clang++", "-###", *words], {str(Path(INPUT).parent): Path(folder), "/usr": self.system})
        found = commands_of(said.stderr)
        if len(found) != 1:
            raise GraderFault(f"the page's compiler does not say what it would do: {shorten(said.stderr, 2000)}")
        (command,) = found
        return command[1:] if not command[0] else command

    def compile_command(self, optimise: str, flags: Sequence[str], *, header: bool = False) -> list[str]:
        """What makes OUTPUT of INPUT, without asking a driver again. A `header` is compiled for later."""
        kind = ["-x", "c++-header"] if header else ["-c", "-x", "c++"]
        return self._command([optimise, *_FLAGS, *_UNCHECKED, *flags, *kind, INPUT, "-o", OUTPUT])

    def link_command(self) -> list[str]:
        """What makes a program, OUTPUT, of the objects and libraries that stand where INPUT does."""
        return self._command([*_LINK_FLAGS, INPUT, "-o", OUTPUT])
