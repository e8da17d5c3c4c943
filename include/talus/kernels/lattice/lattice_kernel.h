#pragma once

#include <talus/core/exceptions.h>
#include <talus/grid/box_grid.h>
#include <talus/kernels/kernel.h>
#include <talus/kernels/lattice/lattice_batch.h>
#include <talus/particles/batch_access.h>

namespace Talus
{
  /**
   * A kernel that is a product over the axes of one function of the distance,
   * Eq. (52). `Function` gives
   * - n: how many nodes per axis can have non-zero weight,
   * - shift: the first of them is floor(lattice coordinate - shift),
   * - support(): beyond this distance the function is zero [h],
   * - evaluate(s, weight, derivative): values at the n nodes of a particle at
   *   distance s from the first [h], and derivatives in s [1/h],
   * - boundary_scale: Steffen's factor, 0 where there is none.
   */
  template <int dim, class Function>
  class LatticeKernel : public Kernel<dim>
  {
  public:
    explicit LatticeKernel(const std::string &section) : Kernel<dim>(section) { function.add_parameters(*this); }

    void choose(Parameters &parameters) override
    {
      const std::string entry = "Boundary treatment";
      treatment               = parameters.make<Treatment<dim>>(this->get_section_name(), entry, "ghost nodes",
                                                  "What happens to the kernel where nodes are missing.");
      if (treatment->needs_boundary_scale() && Function::boundary_scale == 0)
        throw EntryError(this->get_section_name(), entry,
                         "this treatment is defined for linear kernels and B-splines only. Use 'none' or 'WLS'.");
    }

    void attach(const Grid<dim> &grid) override { lattice = &box_grid(grid, "/Kernel", "Type").lattice; }

    void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                  Stencil<dim> *stencils) const override
    {
      const auto                          x = particles.template components<dim>(particles.position);
      const BatchEvaluator<dim, Function> evaluator(function, *lattice, *treatment);
      LatticeBatch<dim, Function::n>      found;
      for_each_batch(begin, end, [&](const auto batch) {
        evaluator.locate(load_vector<dim>(batch, x), found);
        evaluator.evaluate(found);
        for (unsigned int l = 0; l < batch.size(); ++l)
          copy(found, l, stencils[batch.p - begin + l]);
      });
    }

    Reach reach() const override
    {
      return {Function::n, Function::shift, /* at_corners = */ false, Function::n > 3 ? 2u : 1u,
              treatment->has_ghosts()};
    }

    std::optional<double> greatest_stiffness(const double a, const double b) const override
    {
      if (Function::n == 2)
        return {}; // S = 1 / (s (1 - s)) of hats
      double greatest = 0;
      for (unsigned int i = 0; i < 2000; ++i)
      {
        using Number   = Simd<native_width>;
        const double s = Function::shift + (i + 0.5) / 2000;
        Number       weight[Function::n], derivative[Function::n];
        function.evaluate(Number(s), weight, derivative);
        double S = 0, D = 0;
        for (unsigned int k = 0; k < Function::n; ++k)
        {
          const double w = weight[k][0], g = derivative[k][0];
          S += w > 0 ? g * g / w : 0.;
          D += w * (k - s) * (k - s);
        }
        greatest = std::max(greatest, a * S + b / D);
      }
      return greatest;
    }

    std::optional<ProductForm<dim>> product_form() const override { return {{function, *lattice, *treatment}}; }

  private:
    /** The stencil in one lane of a batch as a list. */
    void copy(const LatticeBatch<dim, Function::n> &found, const unsigned int l, Stencil<dim> &stencil) const
    {
      stencil.reserve(found.n_nodes);
      const auto add = [&](const unsigned int place, const unsigned int beyond, const unsigned int *k,
                           const double weight) {
        stencil.place[stencil.size]  = place;
        stencil.beyond[stencil.size] = beyond;
        stencil.weight[stencil.size] = weight;
        for (unsigned int d = 0; d < dim; ++d)
          stencil.offset[d][stencil.size] = found.offset[d][k[d]].data()[l];
      };
      if (found.is_at_face)
      {
        stencil.has_images = found.has_images;
        for (unsigned int d = 0; d < dim; ++d)
          stencil.is_at_slip_wall[d] = lane(found.is_at_slip_wall[d], l);
        for_each_node(*lattice, found, l,
                      [&](const unsigned int i, const auto *k, const auto place, const auto beyond) {
                        add(place, beyond, k, found.value[i].data()[l]);
                        for (unsigned int d = 0; d < dim; ++d)
                          stencil.gradient[d][stencil.size] = found.gradient[d][i].data()[l];
                        ++stencil.size;
                      });
        return;
      }
      stencil.is_at_slip_wall.fill(false);
      for (unsigned int i = 0; i < found.n_nodes; ++i)
      {
        constexpr unsigned int n    = Function::n;
        const unsigned int     k[3] = {i % n, i / n % n, i / (n * n)};
        // The product of the axes' weights, with the derivative in place of that of axis `d`.
        const auto product = [&](const unsigned int d) {
          double result = 1;
          for (unsigned int e = 0; e < dim; ++e)
            result *= (e == d ? found.derivative : found.weight)[e][k[e]].data()[l];
          return result;
        };
        unsigned int place = found.first_node[l];
        for (unsigned int d = 0; d < dim; ++d)
          place += k[d] * lattice->stride[d];
        add(place, 0, k, product(dim));
        for (unsigned int d = 0; d < dim; ++d)
          stencil.gradient[d][stencil.size] = product(d);
        ++stencil.size;
      }
    }

    Function                        function;
    const Lattice<dim>             *lattice = nullptr;
    std::unique_ptr<Treatment<dim>> treatment;
  };
} // namespace Talus
