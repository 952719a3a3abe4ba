// Runs the fuzz target without a fuzzer: every file of the seed corpus, then mutations of each from a fixed seed.
// Usage: fuzz-readers-replay CORPUS_FOLDER [MUTATIONS_PER_FILE]
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "io/files.hpp"
#include "io/numbers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr int k_default_mutations = 400;
constexpr std::uint32_t k_seed = 2026;

class Mutator {
public:
    std::string mutate(std::string bytes) {
        for (std::size_t i = 0, count = 1 + below(4); i < count; ++i) {
            change(bytes);
        }
        return bytes;
    }

private:
    // Not a standard distribution: those differ between libraries.
    std::size_t below(std::size_t limit) { return static_cast<std::size_t>(engine_()) % limit; }

    void change(std::string& bytes) {
        static const std::vector<std::string_view> k_pieces{"nan", "-inf",    "1e40",        "-1e-45", "0",
                                                            "-1",  "1000000", "99999999999", "p",      "pp",
                                                            "v",   "f",       "#",           "\n",     "\r\n"};
        const std::size_t at = below(bytes.size() + 1);
        const std::size_t length = std::min(bytes.size() - at, below(12));
        switch (below(6)) {
            case 0:
                bytes.resize(at);
                break;
            case 1:
                bytes.erase(at, length);
                break;
            case 2:
                bytes.insert(at, bytes.substr(at, length));
                break;
            case 3:
                bytes.insert(at, 1, static_cast<char>(below(256)));
                break;
            case 4:
                bytes.replace(at, length, k_pieces[below(k_pieces.size())]);
                break;
            default:
                if (at < bytes.size()) {
                    bytes[at] = static_cast<char>(below(256));
                }
        }
    }

    std::mt19937 engine_{k_seed};
};

void run(const std::string& bytes) {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

int replay(const std::filesystem::path& folder, int mutations) {
    const std::vector<std::filesystem::path> files = files_in(folder);
    if (files.empty()) {
        std::fprintf(stderr, "fuzz-readers-replay: no seeds in %s\n", raysteps::display_name(folder).c_str());
        return 1;
    }
    Mutator mutator;
    for (const std::filesystem::path& file : files) {
        const std::string bytes = raysteps::read_file(file);
        run(bytes);
        for (int i = 0; i < mutations; ++i) {
            run(mutator.mutate(bytes));
        }
    }
    std::printf("fuzz-readers-replay: %zu seeds and %d mutations of each: passed\n", files.size(), mutations);
    return 0;
}

}  // namespace

int main(int argc, char* argv[]) {
    const std::optional<int> mutations = argc == 3 ? raysteps::parse_whole(argv[2]) : k_default_mutations;
    if (argc < 2 || argc > 3 || !mutations) {
        std::fprintf(stderr, "usage: fuzz-readers-replay CORPUS_FOLDER [MUTATIONS_PER_FILE]\n");
        return 2;
    }
    try {
        return replay(argv[1], *mutations);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "fuzz-readers-replay: %s\n", error.what());
        return 1;
    }
}
