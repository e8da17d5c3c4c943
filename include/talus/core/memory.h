#pragma once

#include <deal.II/base/mpi.h>

namespace Talus
{
  /** Memory of all machines on which the communicator's ranks run, whoever uses it [byte]. Collective. */
  double physical_memory(MPI_Comm communicator);
} // namespace Talus
