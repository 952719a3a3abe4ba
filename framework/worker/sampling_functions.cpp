// Samples, filters and the curve of a screen: step 10.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/random_stream.hpp"
#include "core/threads.hpp"
#include "steps/10-sampling/sampling.hpp"
#include "worker/draws.hpp"
#include "worker/functions.hpp"
#include "worker/protocol.hpp"

namespace raysteps {
namespace {

TokenWriter& write_point(TokenWriter& answer, const glm::vec2& point) { return answer.number(point.x).number(point.y); }

int at_least(int least, int number) {
    if (number < least) {
        throw ProtocolError("expected at least " + std::to_string(least) + ", found " + std::to_string(number));
    }
    return number;
}

Filter read_filter(TokenReader& words) { return words.one_of<Filter>("filter", Filter::mitchell); }

void ask_stratified_samples(TokenReader& words, TokenWriter& answer) {
    const int side = words.whole();
    const auto draw = [&](RandomStream& random) { return stratified_samples(side, random); };
    for (const std::vector<glm::vec2>& points : draw_with_streams(words, draw)) {
        answer.whole(static_cast<long long>(points.size()));
        for (const glm::vec2& point : points) {
            write_point(answer, point);
        }
    }
}

void ask_radical_inverse(TokenReader& words, TokenWriter& answer) {
    const auto base = static_cast<std::uint32_t>(at_least(2, words.whole()));
    answer.number(radical_inverse(base, words.index()));
}

void ask_halton_point(TokenReader& words, TokenWriter& answer) { write_point(answer, halton_point(words.index())); }

void ask_tent_filter(TokenReader& words, TokenWriter& answer) { answer.number(tent_filter(words.number())); }

void ask_mitchell_filter(TokenReader& words, TokenWriter& answer) { answer.number(mitchell_filter(words.number())); }

void ask_reconstruct(TokenReader& words, TokenWriter& answer) {
    const auto filter = read_filter(words);
    std::vector<PixelSample> samples;
    for (int left = words.count(); left > 0; --left) {
        PixelSample sample;
        sample.offset.x = words.number();
        sample.offset.y = words.number();
        sample.light = words.vector();
        samples.push_back(sample);
    }
    answer.vector(reconstruct(samples, filter));
}

void ask_linear_to_srgb(TokenReader& words, TokenWriter& answer) { answer.number(linear_to_srgb(words.number())); }

}  // namespace

void add_sampling(FunctionTable& functions) {
    functions["stratified_samples"] = ask_stratified_samples;
    functions["radical_inverse"] = ask_radical_inverse;
    functions["halton_point"] = ask_halton_point;
    functions["tent_filter"] = ask_tent_filter;
    functions["mitchell_filter"] = ask_mitchell_filter;
    functions["reconstruct"] = ask_reconstruct;
    functions["linear_to_srgb"] = ask_linear_to_srgb;
}

}  // namespace raysteps
