// A program that answers questions with RIB: Procedural "RunProgram". It is started once and kept alive; each
// question is a line on its standard input, each answer RIB on its standard output up to the byte 0377.
#pragma once

#include "slvm/support/result.h"

#include <memory>
#include <string>
#include <vector>

namespace render {

struct ProgramLimits {
  double seconds = 60;            ///< of silence
  size_t bytes = size_t{1} << 30; ///< of one answer
};

class Program {
public:
  /// `command` is a file and its arguments. No shell sees it.
  static slvm::Result<std::unique_ptr<Program>> start(const std::vector<std::string>& command);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// The answer to one question, without its end mark. After an error the program is of no more use.
  slvm::Result<std::string> ask(const std::string& question, const ProgramLimits& limits);

private:
  Program(int process, int to, int from) : process_(process), to_(to), from_(from) {}
  void send(const std::string& text, double seconds) const;
  std::string how_it_ended();

  int process_;
  int to_, from_; ///< ends of the pipes
};

} // namespace render
