// Requests as RIB text, one a line, indented by blocks: the inverse of parser.h. What a parser makes of the
// text are the same requests with the same values to the last bit (but for NaN, which RIB cannot write).
#pragma once

#include "render/rib/ri_target.h"

#include <array>
#include <functional>
#include <string>

namespace render {

struct RibFormat {
  bool binary = false;
  int precision = 0; ///< significant digits of ASCII numbers; 0: as many as it takes
};

class RibWriter : public RiTarget {
public:
  /// `out` receives the text piece by piece, whole requests each time.
  explicit RibWriter(std::function<void(std::string_view)> out, RibFormat format = {});

  void request(const RequestCall& call) override;
  /// Nothing is written of it: its arguments are not known.
  void unknown_request(std::string_view name, std::string_view suggestion, slvm::SourceRange where) override;
  bool wants_comments() const override { return true; }
  void comment(std::string_view text, slvm::SourceRange where) override;
  /// RIB text as it is; a line of its own.
  void verbatim(std::string_view text);

private:
  void header(bool own);
  void version(bool own);
  void begin_line();
  void end_line();
  void name(const RequestInfo& info);
  void argument(const ArgumentInfo& info, const Argument& a);
  void param(const Param& p);
  void space();
  void real(float value);
  void whole(float value);
  void integer(int value);
  void text(std::string_view value);
  void reals(std::span<const float> values, bool told = false);
  void integers(std::span<const int> values);
  void texts(std::span<const std::string> values);

  std::function<void(std::string_view)> out_;
  RibFormat format_;
  std::string line_;
  size_t wrapped_ = 0; ///< where the last part of a long line begins
  int depth_ = 0;
  bool has_header_ = false, has_version_ = false;
  std::string data_name_; ///< of the archive whose content was just written
  std::array<bool, kRequestCount> defined_{};
};

} // namespace render
