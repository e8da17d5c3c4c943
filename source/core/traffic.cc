#include <talus/core/traffic.h>

#include <ctime>

namespace Talus
{
  Traffic &Traffic::here()
  {
    static Traffic traffic;
    return traffic;
  }

  Traffic::Wait::Wait() : start(processor_time()) {}

  Traffic::Wait::~Wait() { here().waiting += processor_time() - start; }

  double processor_time()
  {
    timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
  }
} // namespace Talus
