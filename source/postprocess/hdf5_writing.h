#pragma once

#include <mpi.h>

#include <cstdint>
#include <functional>
#include <string>

namespace Talus
{
  /**
   * Runs `write`, which writes a file of about `n_bytes` bytes with the HDF5 library. Where the disk has no room for
   * it, or anything fails, the file is removed and `message` is thrown as a RunError on all ranks. Collective.
   */
  void write_hdf5_file(const std::string &path, const std::uint64_t n_bytes, const std::function<void()> &write,
                       const std::string &message, MPI_Comm communicator);
} // namespace Talus
