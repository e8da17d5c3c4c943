#pragma once

#include <deal.II/base/mpi.h>

namespace Talus
{
  /** Memory of all machines on which the communicator's ranks run, whoever uses it [byte]. Collective. */
  double physical_memory(MPI_Comm communicator);

  /** Gives back to the system what the C library keeps for later of memory that was taken in many small pieces. */
  void return_free_memory();
} // namespace Talus
