// What a plug-in can ask of the program that runs it: messages, storage, locks, tokens, statistics. From
// RixContext::GetRixInterface(id); null for ids that this program does not serve. Interfaces are not to be
// deleted; a RixMutex is, by who made it.
#pragma once

#include <stddef.h>

enum RixInterfaceId {
  k_RixGlobalData,      ///< RixStorage of the frame: lock it
  k_RixThreadData,      ///< RixStorage of the thread
  k_RixLocalData,       ///< RixStorage of the grid: gone when its shaders have run
  k_RixMessages,        ///< RixMessages
  k_RixStats,           ///< RixStats
  k_RixThreadUtils,     ///< RixThreadUtils
  k_RixGlobalTokenData, ///< RixTokenStorage
  k_RixRenderState,     ///< not served
  k_RixSamplingPattern, ///< not served
  // Other renderers do not have these:
  k_RixGrid,   ///< RixGrid, during a call
  k_RixRunData ///< RixStorage of the program's run, which outlives frames: lock it
};
#define k_RixFrameData k_RixGlobalData

class RixInterface {
public:
  virtual ~RixInterface() {}
  /// Of the interface's functions; 1 so far.
  virtual int GetVersion() const { return 1; }
};

class RixContext {
public:
  virtual ~RixContext() {}
  virtual RixInterface* GetRixInterface(RixInterfaceId id) const = 0;
};

/// Messages of the renderer, which folds equal ones; with Always: the same here. Inside a call of a shader
/// they name its line.
class RixMessages : public RixInterface {
public:
  virtual void Error(const char* format, ...) = 0;
  virtual void ErrorAlways(const char* format, ...) = 0;
  virtual void Warning(const char* format, ...) = 0;
  virtual void WarningAlways(const char* format, ...) = 0;
  virtual void Info(const char* format, ...) = 0;
  virtual void InfoAlways(const char* format, ...) = 0;
};

typedef void (*RixCleanupFunc)(RixContext* context, void* data);

/// Data by name. Cleanup functions are called with what they belong to when it is replaced or cleared, and at
/// the end of the storage's life.
class RixStorage : public RixInterface {
public:
  virtual void* Get(const char* key) = 0;
  virtual void Set(const char* key, void* data, RixCleanupFunc cleanup = NULL) = 0;
  virtual void Clear(const char* key) = 0;
  virtual void Lock() = 0;
  virtual void Unlock() = 0;
};

/// Strings that live as long as the program: what functions may return.
class RixTokenStorage : public RixInterface {
public:
  virtual const char* GetToken(const char* text) = 0;
};

class RixMutex {
public:
  virtual ~RixMutex() {}
  virtual void Lock() = 0;
  virtual void Unlock() = 0;
};

class RixThreadUtils : public RixInterface {
public:
  virtual RixMutex* NewMutex() const = 0;
};

/// Where a reporter writes.
class RixXmlFile {
public:
  virtual ~RixXmlFile() {}
  virtual void WriteXml(const char* format, ...) = 0;
  virtual void WriteText(const char* format, ...) = 0;
};

/// Numbers that are told at the end of the frame, by programs that print statistics (slrender --statistics).
class RixStats : public RixInterface {
public:
  virtual void AddTimerStat(float* seconds, const char* name, const char* description) = 0;
  virtual void AddMemoryStat(size_t* bytes, const char* name, const char* description) = 0;
  typedef void (*Reporter)(RixXmlFile* file);
  virtual void AddReporter(Reporter reporter) = 0;
};

/// How the points of the grid lie to each other, whose run flags and values RslContext and RslArg::GetData
/// give.
class RixGrid : public RixInterface {
public:
  /// The numbers of points along u and along v: point (i, j) has the number j * columns + i. False, and all
  /// 0: the points are hits of rays, which have no neighbours.
  /// Several pieces of surfaces may lie one above the other: only rows of one piece are neighbours, the first
  /// `piece_rows` rows, the next, and so on (of one piece these are all rows).
  virtual bool Size(int* columns, int* rows, int* piece_rows) const = 0;
};
