#pragma once

#include <string>

namespace Talus
{
  /**
   * Keeps the directory of a run from others: the file `talus.lock` there, which names host and process, is locked as
   * long as the process lives. The operating system ends the lock with it, however it ends: what a killed run leaves
   * behind locks nobody out. Where the file system has no locks there is none. Test: tests/checkpoint.
   */
  class DirectoryLock
  {
  public:
    DirectoryLock() = default;
    ~DirectoryLock();
    DirectoryLock(const DirectoryLock &)            = delete;
    DirectoryLock &operator=(const DirectoryLock &) = delete;

    /** What is wrong, or nothing. */
    std::string take(const std::string &directory);

  private:
    std::string path;
    int         file = -1;
  };
} // namespace Talus
