#pragma once

#include <talus/core/parameters.h>

namespace Talus
{
  /**
   * Loads the shared libraries that the entry 'Additional shared libraries' names: what they register can then be chosen
   * as if it were built in. They stay loaded. Before any object of a run is made. Throws EntryError where one cannot be
   * loaded. Test: tests/install.py; theory: doc/extensions.md.
   */
  void load_libraries(const Parameters &parameters);

  /** Declares the entry, where objects declare theirs. */
  void declare_libraries();
} // namespace Talus
