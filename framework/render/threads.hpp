#pragma once
// The same work on several threads at once.
#include <functional>

namespace raysteps {

/// Calls work on `count` threads, the caller's among them, and waits for all. Where the system refuses more
/// threads, those that there are do all the work: work must take its portions from a shared counter.
void run_on_threads(int count, const std::function<void()>& work);

}  // namespace raysteps
