#pragma once

#include <mpi.h>

#include <vector>

namespace Talus
{
  /**
   * One message for all global numbers of a step: `maxima` are replaced by their
   * greatest, `sums` by their sum over all ranks.
   */
  void reduce(std::vector<double> &maxima, std::vector<double> &sums, MPI_Comm communicator);
} // namespace Talus
