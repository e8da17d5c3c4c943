#pragma once

#include <talus/core/parameters.h>
#include <talus/grid/lattice.h>
#include <talus/grid/reach.h>
#include <talus/kernels/lattice/functions.h>
#include <talus/kernels/stencil.h>
#include <talus/kernels/lattice/treatment.h>
#include <talus/particles/working_set.h>

#include <optional>
#include <variant>

namespace Talus
{
  template <int dim>
  class Grid;

  /** A kernel that is a product over the axes of a lattice, but for what a treatment does at its faces. */
  template <int dim>
  struct ProductForm
  {
    ProductFunction       function;
    const Lattice<dim>   &lattice;
    const Treatment<dim> &treatment;

    ProductForm with(const Treatment<dim> &other) const { return {function, lattice, other}; }
  };

  /** A kernel that averages hat functions of a lattice over the corners of particle domains: see CornerHats. */
  template <int dim>
  struct DomainForm
  {
    const Lattice<dim> &lattice;
    unsigned int        half_edges; // the field
  };

  /** The form of a kernel for which loops are compiled. */
  template <int dim>
  using CompiledForm = std::variant<std::monostate, ProductForm<dim>, DomainForm<dim>>;

  /** A kernel function: gives particles their stencils. */
  template <int dim>
  class Kernel : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Particles in one call of evaluate() at most. */
    static constexpr unsigned int max_batch = 8;

    /** Makes the parts that entries of its section choose. */
    virtual void choose(Parameters &) {}

    /** Adds what the kernel needs of particles beyond the common fields. */
    virtual void add_fields(WorkingSet<dim> &) {}

    /** Sets the grid on which stencils are found. */
    virtual void attach(const Grid<dim> &grid) = 0;

    /** Fills `stencils` with those of particles begin .. end - 1, at most max_batch. */
    virtual void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                          Stencil<dim> *stencils) const = 0;

    virtual Reach reach() const = 0;

    /**
     * The greatest of a S + b q over the places of a particle, S = sum_i phi_i'^2 / phi_i and q = 1 / sum_i phi_i s_i^2
     * along an axis with spacing 1: how fast a lone particle vibrates hangs on them. Nothing where they have no bound,
     * or the kernel is no product.
     */
    virtual std::optional<double> greatest_stiffness(const double /* a */, const double /* b */) const { return {}; }

    /**
     * Nodes of less than this share of a particle's mass count as empty. What they are given by a gradient is lost: it
     * must be next to nothing for such a weight.
     */
    virtual double smallest_share() const { return 1e-12; }

    // Forms for which loops are compiled, if the kernel has one; all others run through lists.
    virtual std::optional<ProductForm<dim>> product_form() const { return {}; }
    virtual std::optional<DomainForm<dim>>  domain_form() const { return {}; }

    CompiledForm<dim> compiled_form() const
    {
      if (const auto form = product_form())
        return *form;
      if (const auto form = domain_form())
        return *form;
      return {};
    }
  };
} // namespace Talus
