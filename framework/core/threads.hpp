#pragma once
// The same work on several threads at once: for the pixels of a picture, and for the boxes of a tree.
#include <functional>

namespace raysteps {

/// Threads that building and rendering use unless they are told otherwise: at first one per core.
[[nodiscard]] int default_threads();
void set_default_threads(int count);

/// Calls work on `count` threads, the caller's among them, and waits for all. Where the system refuses more
/// threads, those that there are do all the work: work must take its portions from a shared counter. An exception
/// that leaves work is thrown again in the caller once all threads have ended.
void run_on_threads(int count, const std::function<void()>& work);

}  // namespace raysteps
