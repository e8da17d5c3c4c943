#include <talus/core/memory.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <unistd.h>

namespace Talus
{
  using namespace dealii;

  double physical_memory(MPI_Comm communicator)
  {
    // One rank of each machine speaks for it.
    MPI_Comm machine;
    MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    const bool is_first = Utilities::MPI::this_mpi_process(machine) == 0;
    MPI_Comm_free(&machine);
    const double here = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
    return Utilities::MPI::sum(is_first ? here : 0., communicator);
  }

  void return_free_memory()
  {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
  }
} // namespace Talus
