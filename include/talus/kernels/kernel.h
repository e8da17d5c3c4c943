#pragma once

#include <talus/grid/lattice.h>
#include <talus/kernels/functions.h>
#include <talus/kernels/stencil.h>
#include <talus/kernels/treatment.h>
#include <talus/particles/working_set.h>

#include <memory>
#include <optional>

namespace Talus
{
  /** A kernel function: gives particles their stencils. */
  template <int dim>
  class Kernel : public dealii::ParameterAcceptor
  {
  public:
    using dealii::ParameterAcceptor::ParameterAcceptor;

    /** Sets the lattice on which stencils are found, and what happens at its edge. */
    virtual void attach(const Lattice<dim> &lattice, std::unique_ptr<Treatment<dim>> treatment)
    {
      this->lattice   = &lattice;
      this->treatment = std::move(treatment);
    }

    /** Fills `stencils` with those of particles begin .. end - 1. */
    virtual void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                          Stencil<dim> *stencils) const = 0;

    /** A stencil is the n_nodes() nodes per axis from floor(lattice coordinate - shift()). */
    virtual unsigned int n_nodes() const = 0;
    virtual double       shift() const   = 0;

    /** The function of which the kernel is a product over the axes, if it is one: batched loops run for these. */
    virtual std::optional<LatticeFunction> lattice_function() const { return {}; }

    const Lattice<dim>             *lattice = nullptr;
    std::unique_ptr<Treatment<dim>> treatment;
  };
} // namespace Talus
