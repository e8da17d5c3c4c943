#include <talus/core/registry.h>
#include <talus/kernels/lattice/functions.h>
#include <talus/kernels/lattice/lattice_kernel.h>

namespace Talus
{
  namespace
  {
    template <int dim>
    using Linear = LatticeKernel<dim, LinearFunction>;
    template <int dim>
    using Quadratic = LatticeKernel<dim, QuadraticBSpline>;
    template <int dim>
    using Cubic = LatticeKernel<dim, CubicBSpline>;
    template <int dim>
    using Gimp = LatticeKernel<dim, GimpFunction>;

    const RegisterDimensions<Kernel, Linear>    linear("linear", "linear hat functions of FE_Q(1)");
    const RegisterDimensions<Kernel, Quadratic> quadratic("quadratic B-spline", "quadratic B-splines centred on nodes");
    const RegisterDimensions<Kernel, Cubic>     cubic("cubic B-spline", "cubic B-splines centred on nodes");
    const RegisterDimensions<Kernel, Gimp> gimp("uGIMP", "generalised interpolation with undeformed particle boxes");
  } // namespace
} // namespace Talus
