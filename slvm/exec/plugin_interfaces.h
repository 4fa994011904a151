// What plug-ins ask for through the classes of slvm/plugin/sdk: storage, messages, locks, tokens, statistics.
#pragma once

#include "slvm/plugin/sdk/RslPlugin.h"
#include "slvm/renderer_services.h"
#include "slvm/support/string_pool.h"

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace slvm {

/// Data by name, with cleanup functions that are called with `context`.
class PluginStorage : public RixStorage {
public:
  explicit PluginStorage(RixContext& context) : context_(context) {}
  ~PluginStorage() override { clear(); }
  void* Get(const char* key) override;
  void Set(const char* key, void* data, RixCleanupFunc cleanup) override;
  void Clear(const char* key) override;
  void Lock() override { mutex_.lock(); }
  void Unlock() override { mutex_.unlock(); }
  /// All of it, newest first.
  void clear();

private:
  struct Item {
    std::string key;
    void* data = nullptr;
    RixCleanupFunc cleanup = nullptr;
  };
  void release(Item item);

  RixContext& context_;
  std::recursive_mutex mutex_;
  std::vector<Item> items_;
};

/// Where messages go; `info`: neither warning nor error.
struct PluginMessage {
  bool info = false;
  MessageSeverity severity = MessageSeverity::kError;
  std::string text;
};

class PluginMessages : public RixMessages {
public:
  using Sink = std::function<void(PluginMessage)>;
  explicit PluginMessages(Sink sink) : sink_(std::move(sink)) {}
  void Error(const char* format, ...) override;
  void ErrorAlways(const char* format, ...) override;
  void Warning(const char* format, ...) override;
  void WarningAlways(const char* format, ...) override;
  void Info(const char* format, ...) override;
  void InfoAlways(const char* format, ...) override;

private:
  Sink sink_;
};

class PluginTokens : public RixTokenStorage {
public:
  explicit PluginTokens(StringPool& strings) : strings_(strings) {}
  const char* GetToken(const char* text) override {
    return strings_.text(strings_.intern(text ? text : "")).data();
  }

private:
  StringPool& strings_;
};

class PluginThreadUtils : public RixThreadUtils {
public:
  RixMutex* NewMutex() const override;
};

/// Kept until the end of the frame.
class PluginStatistics : public RixStats {
public:
  void AddTimerStat(float* seconds, const char* name, const char* description) override;
  void AddMemoryStat(size_t* bytes, const char* name, const char* description) override;
  void AddReporter(Reporter reporter) override;
  /// A line for each number, and what reporters write; forgets them.
  std::string take();

private:
  std::mutex mutex_;
  std::vector<std::function<std::string()>> lines_;
};

} // namespace slvm
