// Processes and pipes (POSIX).
#include "render/state/program.h"

#include "render/rib/encoding.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace render {

namespace {

int milliseconds(double seconds) {
  return static_cast<int>(seconds * 1000);
}

} // namespace

slvm::Result<std::unique_ptr<Program>> Program::start(const std::vector<std::string>& command) {
  int in[2], out[2];
  // Not inherited: a second program must not keep the first one's input open.
  if (::pipe2(in, O_CLOEXEC) != 0) return slvm::Error{std::strerror(errno)};
  if (::pipe2(out, O_CLOEXEC) != 0) {
    ::close(in[0]);
    ::close(in[1]);
    return slvm::Error{std::strerror(errno)};
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  std::vector<char*> words;
  for (const std::string& word : command)
    words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  pid_t process = 0;
  int status = ::posix_spawn(&process, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(in[0]);
  ::close(out[1]);
  // A program that does not read must not hold up the renderer.
  ::fcntl(in[1], F_SETFL, O_NONBLOCK);
  if (status != 0) {
    ::close(in[1]);
    ::close(out[0]);
    return slvm::Error{std::strerror(status)};
  }
  return std::unique_ptr<Program>(new Program(process, in[1], out[0]));
}

/// The end of its input tells a program to stop; one that does not is killed.
Program::~Program() {
  ::close(to_);
  ::close(from_);
  if (process_ == 0) return;
  constexpr int kPatience = 100;
  for (int i = 0; i < kPatience; ++i) {
    if (::waitpid(process_, nullptr, WNOHANG) != 0) return;
    ::usleep(1000);
  }
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

/// A program that does not read is found out when there is no answer. The signal that would tell of a closed
/// pipe is held back, as it would end the renderer.
void Program::send(const std::string& text, double seconds) const {
  sigset_t broken, before;
  sigemptyset(&broken);
  sigaddset(&broken, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken, &before);
  size_t sent = 0;
  while (sent < text.size()) {
    pollfd wait{to_, POLLOUT, 0};
    if (::poll(&wait, 1, milliseconds(seconds)) == 0) break;
    ssize_t n = ::write(to_, text.data() + sent, text.size() - sent);
    if (n < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (n <= 0) break;
    sent += static_cast<size_t>(n);
  }
  if (sent < text.size()) {
    timespec now{};
    sigtimedwait(&broken, nullptr, &now);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

std::string Program::how_it_ended() {
  int status = 0;
  // It has closed its output, but may hang around.
  constexpr int kPatience = 1000;
  int i = 0;
  while (::waitpid(process_, &status, WNOHANG) == 0)
    if (::usleep(1000); ++i == kPatience) ::kill(process_, SIGKILL);
  process_ = 0;
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) return "it cannot be run (exit status 127)";
  if (WIFEXITED(status)) return fmt::format("it ended with exit status {}", WEXITSTATUS(status));
  return fmt::format("it was ended by signal {}", WTERMSIG(status));
}

slvm::Result<std::string> Program::ask(const std::string& question, const ProgramLimits& limits) {
  send(question, limits.seconds);
  std::string answer;
  EndMarkFinder finder;
  for (;;) {
    if (size_t end = finder.find(answer); end != EndMarkFinder::kNone) {
      answer.resize(end);
      return answer;
    }
    if (answer.size() > limits.bytes)
      return slvm::Error{fmt::format("its answer is longer than {} MB", limits.bytes >> 20)};
    pollfd wait{from_, POLLIN, 0};
    int ready = ::poll(&wait, 1, milliseconds(limits.seconds));
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) return slvm::Error{fmt::format("it was silent for {:g} seconds", limits.seconds)};
    char buffer[1 << 16];
    ssize_t n = ::read(from_, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0)
      return slvm::Error{how_it_ended() + (answer.empty() ? ", without an answer"
                                                          : ", its answer lacks the end mark (byte 0377)")};
    answer.append(buffer, static_cast<size_t>(n));
  }
}

} // namespace render
