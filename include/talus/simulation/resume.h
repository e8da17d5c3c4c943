#pragma once

#include <talus/core/parameters.h>
#include <talus/postprocess/checkpoint_file.h>
#include <talus/postprocess/directory_lock.h>

namespace Talus
{
  /**
   * From where a run goes on: the last complete checkpoint in the directory of its output. Parameters are those of the
   * checkpoint, and the directory is this one, wherever it stands now; no other run gets into it as long as this is
   * there. Test: tests/checkpoint.
   */
  class Resume
  {
  public:
    /** Looks for the checkpoint. Throws InputError where there is none, or none that is complete. Collective. */
    Resume(const std::string &directory, MPI_Comm communicator);

    /**
     * Those of the run, changed by `overrides`: of the whole file, with all stages. Throws InputError for an entry that
     * may not change.
     */
    Parameters parameters(const std::vector<std::string> &overrides) const;

    /** Whether one of `overrides` is of this entry. */
    static bool changes(const std::vector<std::string> &overrides, const std::string &key);

    const std::string        directory;
    std::string              file;     // of the checkpoint
    CheckpointHead           head;     // its head
    std::vector<std::string> warnings; // newer files that are damaged

  private:
    DirectoryLock lock; // of the first rank
  };
} // namespace Talus
