#pragma once

#include "../setup.h"

namespace Test
{
  template <int dim>
  dealii::Tensor<1, dim> velocity(const Setup<dim> &setup, const unsigned int p)
  {
    dealii::Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = setup.particles.component(setup.particles.velocity, d)[p];
    return v;
  }

  template <int dim>
  dealii::Tensor<2, dim> matrix(const Setup<dim> &setup, const unsigned int field, const unsigned int p)
  {
    dealii::Tensor<2, dim> A;
    for (unsigned int c = 0; c < dim * dim; ++c)
      A[c / dim][c % dim] = setup.particles.component(field, c)[p];
    return A;
  }

  template <int dim>
  dealii::Tensor<1, dim> node_vector(const Setup<dim> &setup, const unsigned int node, const unsigned int lane)
  {
    dealii::Tensor<1, dim> v;
    for (unsigned int d = 0; d < dim; ++d)
      v[d] = setup.grid.fields[node][lane + d];
    return v;
  }

  template <int dim>
  std::string box_body(const std::array<double, 3> &lower, const std::array<double, 3> &upper, const double jitter)
  {
    return body_text(set("Lower corner", coordinates<dim>(lower)) + set("Upper corner", coordinates<dim>(upper)) +
                     set("Jitter", std::to_string(jitter)));
  }

  /** Particles with jitter in all cells of a small box. */
  template <int dim>
  std::string full_box(const std::string &kernel, const std::string &treatment, const std::string &transfer,
                       const std::string &more = "")
  {
    const std::array<int, 3> cells = {{dim == 2 ? 6 : 4, dim == 2 ? 5 : 4, 4}};
    return skewed_grid<dim>(cells) + kernel_text(kernel, treatment) + transfer_text(transfer, more) +
           box_body<dim>({{-0.3, 0.7, 0.2}}, {{-0.3 + 0.1 * cells[0], 0.7 + 0.08 * cells[1], 0.2 + 0.125 * cells[2]}},
                         0.5);
  }

  /** Random velocity, velocity gradient and, with APIC, B. */
  template <int dim>
  void randomize_motion(Setup<dim> &setup)
  {
    auto &particles = setup.particles;
    setup.randomize(particles.velocity, 1);
    setup.randomize(particles.grad_v, 2);
    for (unsigned int f = 0; f < particles.fields.size(); ++f)
      if (particles.fields[f].name == "affine moment")
      {
        // Any B that is of the order of v h, and not only what a velocity gradient gives.
        setup.fill(
          f, [&](const unsigned int p, const unsigned int c) { return 0.1 * hashed_jitter(3, particles.id[p], c); });
      }
  }

  /** A matrix without symmetry. */
  template <int dim>
  dealii::Tensor<2, dim> some_gradient()
  {
    dealii::Tensor<2, dim> L;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        L[d][e] = std::sin(1. + 2.3 * d + 5.1 * e);
    return L;
  }
} // namespace Test
