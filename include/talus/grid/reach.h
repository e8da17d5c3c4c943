#pragma once

namespace Talus
{
  /**
   * What a kernel, or a transfer, may ask of the grid around a particle: the `n` nodes per axis from
   * floor(lattice coordinate - shift) of the particle or, if `at_corners`, of each corner of its domain too.
   */
  struct Reach
  {
    unsigned int n          = 0;
    double       shift      = 0;
    bool         at_corners = false;
    unsigned int layers     = 1;     // of cells beyond its own that a rank must know with all their nodes
    bool         ghosts     = false; // a layer of nodes beyond each face of the domain: see Walls
  };
} // namespace Talus
