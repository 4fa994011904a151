// Signals of the guarded call's own thread lead back to where it was made.
#include "slvm/support/crash_guard.h"

#include <csetjmp>
#include <csignal>
#include <exception>
#include <iterator>

namespace slvm {
namespace {

constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL};

// A signal handler gets no argument: where this thread's guarded call was made.
thread_local sigjmp_buf* crash_point = nullptr;

void on_crash(int signal) {
  if (crash_point) siglongjmp(*crash_point, signal);
  std::signal(signal, SIG_DFL); // not ours: as it would have been
  std::raise(signal);
}

const char* name_of(int signal) {
  return signal == SIGSEGV  ? "segmentation fault"
         : signal == SIGBUS ? "bus error"
         : signal == SIGFPE ? "arithmetic error"
                            : "illegal instruction";
}

} // namespace

std::string call_catching(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return std::string("it threw an exception: ") + e.what();
  } catch (...) {
    return "it threw an exception";
  }
  return "";
}

std::string call_guarded(const std::function<void()>& f) {
  struct sigaction ours {
  }, before[std::size(kSignals)];
  ours.sa_handler = on_crash;
  sigemptyset(&ours.sa_mask);
  ours.sa_flags = SA_NODEFER;
  sigjmp_buf here;
  sigjmp_buf* const outer = crash_point;
  std::string result;
  for (size_t i = 0; i < std::size(kSignals); ++i)
    ::sigaction(kSignals[i], &ours, &before[i]);
  if (const int signal = sigsetjmp(here, 1); signal == 0) {
    crash_point = &here;
    result = call_catching(f);
  } else {
    result = std::string("it crashed (") + name_of(signal) + ")";
  }
  crash_point = outer;
  for (size_t i = 0; i < std::size(kSignals); ++i)
    ::sigaction(kSignals[i], &before[i], nullptr);
  return result;
}

} // namespace slvm
