// Prototypes in the tables of plug-ins. What is read has a signature that can be read, too, and says the
// same.
#include "slvm/plugin/prototype.h"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  auto prototype = slvm::parse_prototype(text);
  if (!prototype) {
    if (prototype.error().empty() || prototype.error().size() > 200) std::abort();
  } else {
    auto made =
        slvm::PluginShadeop::make({prototype->name, prototype->signature(), "", slvm::PluginForm::kGrid});
    if (!made || static_cast<size_t>(made->info().signature.param_count) != prototype->params.size())
      std::abort();
    for (size_t i = 0; i < prototype->params.size(); ++i) {
      const slvm::SignatureParam& p = made->info().signature.param(static_cast<int>(i));
      const slvm::PrototypeParam& q = prototype->params[i];
      if (p.type != q.type || p.array != q.array || p.elements != q.elements || p.output != q.output ||
          p.uniform != q.uniform)
        std::abort();
    }
    if (!made->storing_to(std::vector<bool>(prototype->params.size(), true))) std::abort();
  }
  // The text as a signature, as a damaged .slo file has it.
  if (auto direct = slvm::PluginShadeop::make({"f", std::string(text), "", slvm::PluginForm::kPointwise}))
    direct->storing_to({true});
  return 0;
}
