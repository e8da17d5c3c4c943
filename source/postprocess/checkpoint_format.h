#pragma once

#include <talus/particles/column_names.h>
#include <talus/postprocess/checksum.h>

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace Talus
{
  /** Grows when older files cannot be read any more. */
  constexpr unsigned int checkpoint_format = 4;

  /** The line after HDF5's part of the file, of a length that hangs on nothing. */
  inline std::string end_of_checkpoint(const std::uint64_t n_bytes, const std::uint64_t checksum)
  {
    char number[24];
    std::snprintf(number, sizeof(number), "%020llu", static_cast<unsigned long long>(n_bytes));
    return "\nTalus checkpoint of " + std::string(number) + " bytes, checksum " + hexadecimal(checksum) + '\n';
  }
} // namespace Talus
