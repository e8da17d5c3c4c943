#pragma once

namespace Talus
{
  /**
   * The nodes a particle talks to, each with weight phi_ip [1], gradient
   * grad phi_ip [1/length] and offset x_i - x_p [length]. This is all that
   * transfers know of kernels.
   */
  template <int dim>
  struct Stencil
  {
    static constexpr unsigned int capacity = dim == 2 ? 16 : 64;

    unsigned int size;
    unsigned int node[capacity]; // local node numbers
    double       weight[capacity];
    double       offset[dim][capacity];
    double       gradient[dim][capacity];

    unsigned char beyond[capacity];     // faces of the box in which the node stands for its mirror image; mostly none
    bool          is_at_slip_wall[dim]; // nodes are missing along this axis, beyond a slip wall
  };
} // namespace Talus
