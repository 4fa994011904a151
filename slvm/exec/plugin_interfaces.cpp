#include "slvm/exec/plugin_interfaces.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <fmt/format.h>

namespace slvm {
namespace {

constexpr size_t kLongestText = 4096; // of a message: longer ones are cut

std::string formatted(const char* format, va_list arguments) {
  std::string text(kLongestText, '\0');
  const int length = std::vsnprintf(text.data(), text.size(), format, arguments);
  text.resize(length < 0 ? 0 : std::min(static_cast<size_t>(length), text.size() - 1));
  while (text.ends_with('\n'))
    text.pop_back();
  return text;
}

class Mutex : public RixMutex {
public:
  void Lock() override { mutex_.lock(); }
  void Unlock() override { mutex_.unlock(); }

private:
  std::mutex mutex_;
};

class TextFile : public RixXmlFile {
public:
  void WriteXml(const char* format, ...) override;
  void WriteText(const char* format, ...) override;
  std::string text;
};

} // namespace

#define FORMATTED(text)                                                                                      \
  va_list arguments;                                                                                         \
  va_start(arguments, format);                                                                               \
  const std::string text = formatted(format, arguments);                                                     \
  va_end(arguments)

void PluginMessages::Error(const char* format, ...) {
  FORMATTED(text);
  sink_({false, MessageSeverity::kError, text});
}
void PluginMessages::ErrorAlways(const char* format, ...) {
  FORMATTED(text);
  sink_({false, MessageSeverity::kError, text});
}
void PluginMessages::Warning(const char* format, ...) {
  FORMATTED(text);
  sink_({false, MessageSeverity::kWarning, text});
}
void PluginMessages::WarningAlways(const char* format, ...) {
  FORMATTED(text);
  sink_({false, MessageSeverity::kWarning, text});
}
void PluginMessages::Info(const char* format, ...) {
  FORMATTED(text);
  sink_({true, MessageSeverity::kWarning, text});
}
void PluginMessages::InfoAlways(const char* format, ...) {
  FORMATTED(text);
  sink_({true, MessageSeverity::kWarning, text});
}

namespace {

void TextFile::WriteXml(const char* format, ...) {
  FORMATTED(line);
  text += line + "\n";
}
void TextFile::WriteText(const char* format, ...) {
  FORMATTED(line);
  text += line + "\n";
}

} // namespace

#undef FORMATTED

void* PluginStorage::Get(const char* key) {
  std::lock_guard lock(mutex_);
  for (const Item& item : items_)
    if (item.key == key) return item.data;
  return nullptr;
}

void PluginStorage::Set(const char* key, void* data, RixCleanupFunc cleanup) {
  std::lock_guard lock(mutex_);
  Clear(key);
  items_.push_back({key, data, cleanup});
}

void PluginStorage::Clear(const char* key) {
  std::lock_guard lock(mutex_);
  auto it = std::find_if(items_.begin(), items_.end(), [&](const Item& item) { return item.key == key; });
  if (it == items_.end()) return;
  Item item = std::move(*it);
  items_.erase(it); // before its function, which may use the storage
  release(std::move(item));
}

void PluginStorage::release(Item item) {
  if (!item.cleanup) return;
  try {
    item.cleanup(&context_, item.data);
  } catch (...) { // nobody is left who could be told
  }
}

void PluginStorage::clear() {
  std::lock_guard lock(mutex_);
  while (!items_.empty()) {
    Item item = std::move(items_.back());
    items_.pop_back();
    release(std::move(item));
  }
}

RixMutex* PluginThreadUtils::NewMutex() const {
  return new Mutex;
}

void PluginStatistics::AddTimerStat(float* seconds, const char* name, const char* description) {
  std::lock_guard lock(mutex_);
  lines_.push_back([seconds, label = std::string(name), text = std::string(description ? description : "")] {
    return fmt::format("{}: {:.3f} s{}{}\n", label, *seconds, text.empty() ? "" : ", ", text);
  });
}

void PluginStatistics::AddMemoryStat(size_t* bytes, const char* name, const char* description) {
  std::lock_guard lock(mutex_);
  lines_.push_back([bytes, label = std::string(name), text = std::string(description ? description : "")] {
    return fmt::format("{}: {} bytes{}{}\n", label, *bytes, text.empty() ? "" : ", ", text);
  });
}

void PluginStatistics::AddReporter(Reporter reporter) {
  std::lock_guard lock(mutex_);
  lines_.push_back([reporter] {
    TextFile file;
    reporter(&file);
    return file.text;
  });
}

std::string PluginStatistics::take() {
  std::lock_guard lock(mutex_);
  std::string all;
  for (const auto& line : lines_)
    all += line();
  lines_.clear();
  return all;
}

} // namespace slvm
