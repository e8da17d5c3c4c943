#pragma once

#include <string>

namespace Talus
{
  /**
   * What a parameter file may have, with help, defaults and units: all sections with the objects that are chosen by
   * default (an empty topic), one section ("Run"), or an object of one kind ("Materials/Drucker-Prager"). Throws
   * InputError, which says what there is, for any other topic. Test: tests/inputs/outputs.py.
   */
  std::string parameters_on(const std::string &topic);
} // namespace Talus
