#include "points.h"
#include "reference.h"

using namespace Test;

namespace
{
  /** The greatest defects of a stencil in what Eqs. (38)-(41) ask for. */
  struct Defects
  {
    double unity = 0, linear = 0, gradient = 0;

    template <int dim>
    void add(const Setup<dim> &setup, const dealii::Point<dim> &x, const Stencil<dim> &stencil)
    {
      const auto            &h   = setup.grid.lattice.h;
      double                 sum = -1;
      dealii::Tensor<1, dim> first;
      dealii::Tensor<2, dim> slope;
      for (unsigned int d = 0; d < dim; ++d)
        slope[d][d] = -1;
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const dealii::Tensor<1, dim> offset = setup.grid.node_position(setup.node(stencil, k)) - x;
        sum += stencil.weight[k];
        for (unsigned int d = 0; d < dim; ++d)
        {
          first[d] += stencil.weight[k] * offset[d] / h[d];
          for (unsigned int e = 0; e < dim; ++e)
            slope[d][e] += stencil.gradient[d][k] * offset[e];
        }
      }
      raise(unity, sum);
      for (unsigned int d = 0; d < dim; ++d)
      {
        raise(linear, first[d]);
        for (unsigned int e = 0; e < dim; ++e)
          raise(gradient, slope[d][e]);
      }
    }
  };

  template <int dim>
  Defects greatest_defects(const std::string &kernel, const std::string &treatment, const bool only_interior = false)
  {
    KernelSetup<dim> setup(kernel, treatment);
    Defects          defects;
    const double     support = Reference::Function(kernel).support;
    setup.for_points([&](const auto &x) {
      if (!only_interior || !setup.is_near_boundary(x, support))
        defects.add(setup, x, setup.at(x));
    });
    return defects;
  }
} // namespace

template <int dim>
void reproduction()
{
  for (const std::string treatment : {"WLS", "WLS separable", "WLS everywhere", "MLS"})
    for (const auto &kernel : Reference::kernels)
    {
      const Defects     defects = greatest_defects<dim>(kernel, treatment);
      const std::string name    = kernel + ", " + treatment;
      check(name + ": partition of unity", defects.unity, 1e-13);
      check(name + ": linear reproduction", defects.linear, 1e-13);
      check(name + ": gradient consistency", defects.gradient, 1e-13);
    }
  for (const std::string treatment : {"none", "Steffen"})
    for (const auto &kernel : Reference::kernels)
      if (treatment == "none" || kernel != "uGIMP")
      {
        const Defects     defects = greatest_defects<dim>(kernel, treatment, true);
        const std::string name    = kernel + ", " + treatment + ", interior";
        check(name + ": partition of unity", defects.unity, 1e-13);
        check(name + ": linear reproduction", defects.linear, 1e-13);
        check(name + ": gradient consistency", defects.gradient, 1e-13);
      }
}

/**
 * Next to a wall Steffen's quadratic functions are 1 - 4/3 x^2 and 4/3 x^2 [h], so sum phi x_i - x = 4/3 x^2 - x with
 * extremum -3/16 at 3/8 and slope -1 at 0. Cubic: 3/2 x^2 - 7/12 x^3 - x, extremum at (6 - 2 sqrt 2)/7.
 */
template <int dim>
void steffen()
{
  const Defects quadratic = greatest_defects<dim>("quadratic B-spline", "Steffen");
  check("quadratic: partition of unity", quadratic.unity, 1e-13);
  check("quadratic: defect of linear reproduction", max(quadratic.linear) - 3. / 16, 1e-13);
  check("quadratic: defect of gradient", max(quadratic.gradient) - 1, 1e-13);

  const Defects cubic = greatest_defects<dim>("cubic B-spline", "Steffen");
  const double  x     = (6 - 2 * std::sqrt(2.)) / 7;
  const double  most  = x - 1.5 * x * x + 7. / 12 * x * x * x;
  check("cubic: partition of unity", cubic.unity, 1e-13);
  check("cubic: defect of linear reproduction", max(cubic.linear) - most,
        0.005); // the extremum is met by random points
  check("cubic: defect of gradient", max(cubic.gradient) - 1, 1e-13);

  check_error<EntryError>("uGIMP has no Steffen functions", {"/Kernel", "Boundary treatment", "WLS"},
                          [] { KernelSetup<dim> setup("uGIMP", "Steffen"); });
}

template void reproduction<2>();
template void reproduction<3>();
template void steffen<2>();
template void steffen<3>();
