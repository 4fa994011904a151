// Who receives the requests of a RIB stream: the renderer's interpreter, a filter, a printer, a test.
#pragma once

#include "render/rib/request.h"

namespace render {

class RiTarget {
public:
  virtual ~RiTarget() = default;
  /// One request, its arguments complete and of the right kinds. The call is reused: copy what must last.
  virtual void request(const RequestCall& call) = 0;
  /// A word that is no request; its arguments have been skipped. `suggestion` may be empty.
  virtual void unknown_request(std::string_view name, std::string_view suggestion,
                               slvm::SourceRange where) = 0;
  /// Whether comment() is to be called.
  virtual bool wants_comments() const { return false; }
  /// A comment between requests, without its first # and the line end. One inside a request comes after it.
  virtual void comment(std::string_view /*text*/, slvm::SourceRange /*where*/) {}
};

} // namespace render
