#pragma once

#include <ostream>

namespace Talus
{
  /** Writes every registered object of every kind with its help, one line each. */
  void list_registered(std::ostream &out);
} // namespace Talus
