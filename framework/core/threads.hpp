#pragma once
// The same work on several threads at once: for the pixels of a picture, and for the boxes of a tree.
#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

namespace raysteps {

/// Threads that building and rendering use unless they are told otherwise: at first one per core.
[[nodiscard]] int default_threads();
void set_default_threads(int count);

/// Calls work on `count` threads, the caller's among them, and waits for all. Where the system refuses more
/// threads, those that there are do all the work: work must take its portions from a shared counter. An exception
/// that leaves work is thrown again in the caller once all threads have ended.
void run_on_threads(int count, const std::function<void()>& work);

/// Takes the place of run_on_threads from now on: for a program whose work waits for another one.
using WorkRunner = void (*)(int count, const std::function<void()>& work);
void set_work_runner(WorkRunner runner);
/// Whether that was done. Then work had better be cut into many small parts, of which many wait at the same time.
[[nodiscard]] bool work_waits();

/// Work on the numbers from begin to end - 1; `what` is what it was given to run_in_portions for.
using PortionWork = void (*)(const void* what, std::size_t begin, std::size_t end);

/// Calls work(what, begin, end) for portions, not of size 0, that together are the numbers from 0 to count - 1, on so
/// many threads, or one for each portion where these are fewer. A single portion is the caller's.
void run_in_portions(int threads, std::size_t count, std::size_t portion, PortionWork work, const void* what);

/// Calls work(0) to work(count - 1), each once, in any order and on so many threads, which take `portion` numbers at a
/// time.
template <typename Work>
void share_among_threads(int threads, std::size_t count, std::size_t portion, const Work& work) {
    const PortionWork on_portion = [](const void* what, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            (*static_cast<const Work*>(what))(i);
        }
    };
    run_in_portions(threads, count, portion, on_portion, &work);
}

/// Threads that nobody else has for as long as this lives, so many at most: of default_threads(), without the caller's.
class SpareThreads {
public:
    explicit SpareThreads(std::size_t most);
    ~SpareThreads();
    SpareThreads(const SpareThreads&) = delete;
    SpareThreads& operator=(const SpareThreads&) = delete;
    [[nodiscard]] int count() const { return count_; }

private:
    int count_ = 0;
};

/// On the caller's thread and those to spare: in work that calls this again there are never more than
/// default_threads() in all.
template <typename Work>
void for_each_on_threads(std::size_t count, std::size_t portion, const Work& work) {
    const SpareThreads spare(count == 0 ? 0 : (count - 1) / portion);  // one portion is the caller's
    share_among_threads(1 + spare.count(), count, portion, work);
}

/// On the caller's thread alone; many at once where work waits for another program. What it costs does not depend on
/// which thread was quicker.
template <typename Work>
void for_each_in_turn(std::size_t count, const Work& work) {
    share_among_threads(1, count, 1, work);
}

/// What make(0) to make(count - 1) give, in this order, called as for_each_in_turn does. Surfaces, textures and trees
/// that a step is asked about are not made in `make`, but before, and stay as they are: a box takes those at the same
/// address for the same meanwhile.
template <typename Make>
auto made_in_turn(std::size_t count, Make make) {
    std::vector<std::remove_cvref_t<std::invoke_result_t<Make&, std::size_t>>> made(count);
    for_each_in_turn(count, [&](std::size_t i) { made[i] = make(i); });
    return made;
}

/// What ask(question) gives for each of them, in their order; asked as made_in_turn makes.
template <typename Question, typename Ask>
auto answers_to(const std::vector<Question>& questions, Ask ask) {
    return made_in_turn(questions.size(), [&](std::size_t i) { return ask(questions[i]); });
}

}  // namespace raysteps
