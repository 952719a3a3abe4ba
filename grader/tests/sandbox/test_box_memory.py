"""What a program finds that reads every file of its box and all of its memory: no machine code of a reference."""

import re
from pathlib import Path

from machine_code import reference_code
from sandboxes import sandbox

from raysteps.course.project import Project
from raysteps.images.render import render
from raysteps.sandbox.task import Sandbox
from raysteps.toolchain.compile import StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit
from raysteps.toolchain.limits import limits_of

__all__ = ["sandbox"]  # pytest finds fixtures by name

_MASK = 0x5A  # what is looked for is no find itself
_CONTROL = b"a sentence that is certainly in this box"

_SEARCH = """
#include "steps/07-tone-mapping/tone_mapping.hpp"

#include <link.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

namespace {

const char* volatile control = "CONTROL";  // one piece, however it is printed
struct Piece { const char* masked; std::size_t size; };
const Piece pieces[] = {PIECES};

char unmasked(char byte) { return static_cast<char>(byte ^ MASK); }
bool is_unmasked(char masked, char plain) { return unmasked(masked) == plain; }

constexpr std::size_t head = 8;
std::unordered_multimap<std::uint64_t, std::size_t> by_head;
std::vector<bool> may_begin(65536);

std::uint64_t head_at(const char* at) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, head);
    return word;
}

void learn() {
    for (std::size_t i = 0; i < std::size(pieces); ++i) {
        char plain[head];
        std::transform(pieces[i].masked, pieces[i].masked + head, plain, unmasked);
        by_head.emplace(head_at(plain), i);
        may_begin[head_at(plain) & 0xFFFFU] = true;
    }
}

struct Found {
    std::vector<bool> which = std::vector<bool>(std::size(pieces));
    std::uint64_t bytes = 0;
    int places = 0;
};

void search(const char* data, std::size_t size, Found& found) {
    found.bytes += size;
    ++found.places;
    for (std::size_t at = 0; at + head <= size; ++at) {
        const std::uint64_t word = head_at(data + at);
        if (!may_begin[word & 0xFFFFU]) {
            continue;
        }
        const auto [first, last] = by_head.equal_range(word);
        for (auto one = first; one != last; ++one) {
            const Piece& piece = pieces[one->second];
            if (at + piece.size <= size &&
                std::equal(piece.masked, piece.masked + piece.size, data + at, is_unmasked)) {
                found.which[one->second] = true;
            }
        }
    }
}

using Regions = std::vector<std::pair<std::uintptr_t, std::uintptr_t>>;

int add_readable(dl_phdr_info* object, std::size_t, void* regions) {
    for (int i = 0; i < object->dlpi_phnum; ++i) {
        const auto& part = object->dlpi_phdr[i];
        if (part.p_type == PT_LOAD && (part.p_flags & PF_R) != 0) {
            const std::uintptr_t begin = object->dlpi_addr + part.p_vaddr;
            static_cast<Regions*>(regions)->emplace_back(begin, begin + part.p_filesz);
        }
    }
    return 0;
}

Found search_memory() {
    Found found;
    std::ifstream maps("/proc/self/maps");
    Regions regions;
    for (std::string line; std::getline(maps, line);) {
        std::uintptr_t begin = 0;
        std::uintptr_t end = 0;
        char dash = 0;
        std::string rights;
        std::istringstream(line) >> std::hex >> begin >> dash >> end >> rights;
        if (rights[0] == 'r' && line.find("[v") == std::string::npos) {
            regions.emplace_back(begin, end);
        }
    }
    if (regions.empty()) {  // the file is not there for everybody
        dl_iterate_phdr(add_readable, &regions);
    }
    for (const auto& [begin, end] : regions) {
        search(reinterpret_cast<const char*>(begin), end - begin, found);
    }
    return found;
}

Found search_files() {
    namespace fs = std::filesystem;
    Found found;
    const auto options = fs::directory_options::skip_permission_denied;
    for (const fs::path& top : {"/", "/proc/self/fd", "/proc/self/map_files"}) {
        std::error_code ignored;
        for (fs::recursive_directory_iterator at(top, options, ignored), end; at != end; at.increment(ignored)) {
            const std::string path = at->path().string();
            // What lies in /usr came with the system, and the kit is not in it.
            if (path == "/proc" || path == "/dev" || path == "/sys" || path == "/usr") {
                at.disable_recursion_pending();
                continue;
            }
            if (!at->is_regular_file(ignored)) {
                continue;
            }
            std::ifstream file(path, std::ios::binary);
            const std::string data{std::istreambuf_iterator<char>(file), {}};
            search(data.data(), data.size(), found);
        }
    }
    return found;
}

std::string in_words(const Found& found) {
    const auto count = std::count(found.which.begin(), found.which.end() - 1, true);
    std::ostringstream words;
    words << count << " of " << std::size(pieces) - 1 << " in " << found.places << " places with " << found.bytes
          << " bytes, control " << found.which.back() << "; ";
    return words.str();
}

}  // namespace

namespace raysteps {

Color tone_map(const Color&) {
    static const std::string words = [] {  // many pixels are asked for at once
        learn();
        return "memory: " + in_words(search_memory()) + "files: " + in_words(search_files()) + control;
    }();
    throw std::runtime_error(words);
}

std::uint8_t to_byte(float) { return 0; }

}  // namespace raysteps
"""


def _literal(data: bytes) -> str:
    return '"' + "".join(f"\\x{byte ^ _MASK:02x}" for byte in data) + '"'


def test_no_reference_is_in_a_box_that_runs(kit: BuiltKit, project: Project, sandbox: Sandbox, tmp_path: Path) -> None:
    looked_for = [*reference_code(kit).values(), _CONTROL]
    pieces = ",\n".join(f"{{{_literal(piece)}, {len(piece)}}}" for piece in looked_for)
    source = _SEARCH.replace("PIECES", pieces).replace("MASK", str(_MASK)).replace("CONTROL", _CONTROL.decode())
    step = next(step for step in kit.steps if step.number == "07")
    limits = limits_of(step, {"seconds": 60.0})
    build = StudentBuild(kit, sandbox, tmp_path)
    compiled = build.compile(step, source.encode(), limits)
    assert compiled.binary is not None, compiled.ran.outcome.stderr
    program, _ = build.program("raytrace", step, {step.number: compiled.binary}, limits)
    assert program is not None
    case = step.images[0]
    ran = render(sandbox, program, project.root / case.scene, case.args, limits.of_program()).ran
    words = ran.outcome.stderr
    finds = re.findall(r"(\d+) of (\d+) in (\d+) places with (\d+) bytes, control (\d)", words)
    assert len(finds) == 2, (words, ran)
    for found, all_pieces, *_ in finds:
        assert (int(found), int(all_pieces)) == (0, len(looked_for) - 1), words
    memory, files = finds
    assert int(memory[3]) > 1_000_000, words
    assert memory[4] == "1", words
    # Without bubblewrap it may open files that are named to it, and list no folder.
    assert files[4] == ("1" if sandbox.isolation.strong else "0"), words
