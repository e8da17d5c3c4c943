#include <talus/core/communicator.h>

#include <ctime>

namespace Talus
{
  double processor_time()
  {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }
} // namespace Talus
