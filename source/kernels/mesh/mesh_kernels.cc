#include <talus/core/registry.h>
#include <talus/grid/simplex_grid.h>
#include <talus/kernels/kernel.h>
#include <talus/kernels/mesh/c1_umls.h>
#include <talus/kernels/mesh/p1.h>
#include <talus/kernels/mesh/umls.h>

namespace Talus
{
  namespace
  {
    /** A kernel on a mesh: finds the list of a particle's nodes from its cell and its position. */
    template <int dim>
    class MeshKernel : public Kernel<dim>
    {
    public:
      using Kernel<dim>::Kernel;

      void attach(const Grid<dim> &grid) override
      {
        mesh = &simplex_grid(grid, this->get_section_name(), "Type").mesh();
      }

      Reach reach() const override { return {}; }

      void evaluate(const WorkingSet<dim> &particles, const unsigned int begin, const unsigned int end,
                    Stencil<dim> *stencils) const override
      {
        const auto     x = particles.template components<dim>(particles.position);
        MeshPoint<dim> points[mesh_width];
        for (unsigned int first = begin; first < end; first += mesh_width)
        {
          const unsigned int n = std::min(mesh_width, end - first);
          for (unsigned int l = 0; l < n; ++l)
          {
            points[l].cell = particles.place[first + l];
            for (unsigned int d = 0; d < dim; ++d)
              points[l].x[d] = x[d][first + l];
            stencils[first - begin + l].is_at_slip_wall.fill(false);
          }
          find(n, points, stencils + (first - begin));
        }
      }

    protected:
      /** The lists of up to mesh_width points. */
      virtual void find(const unsigned int n, const MeshPoint<dim> *points, Stencil<dim> *lists) const = 0;

      const Mesh<dim> *mesh = nullptr;
    };

    template <int dim>
    class P1 : public MeshKernel<dim>
    {
    public:
      using MeshKernel<dim>::MeshKernel;

    private:
      void find(const unsigned int n, const MeshPoint<dim> *points, Stencil<dim> *lists) const override
      {
        for (unsigned int l = 0; l < n; ++l)
          p1(*this->mesh, points[l].cell, points[l].x.data(), lists[l]);
      }
    };

    /** Unstructured moving least squares, Cao et al.; see umls(). */
    template <int dim>
    class Umls : public MeshKernel<dim>
    {
    public:
      explicit Umls(const std::string &section) : MeshKernel<dim>(section)
      {
        this->add_parameter("Weight", weight, "Function of the distance: a centred B-spline.", this->prm,
                            dealii::Patterns::Selection("cubic|quadratic"));
        this->add_parameter("Support", support,
                            "Length s of the weights: the longest edge at each vertex, interpolated, or that of the "
                            "whole mesh.",
                            this->prm, dealii::Patterns::Selection("local|global"));
        this->add_parameter("Gamma", options.has_gamma,
                            "Factors that make the kernel continuous across faces. Without them it jumps: for "
                            "comparison only.");
      }

      void parse_parameters(dealii::ParameterHandler &) override
      {
        options.support = support == "local" ? UmlsOptions::Support::local : UmlsOptions::Support::global;
        is_cubic        = weight == "cubic";
      }

    protected:
      void find(const unsigned int n, const MeshPoint<dim> *points, Stencil<dim> *lists) const override
      {
        if (is_cubic)
          umls<CubicWeight>(*this->mesh, n, points, options, lists);
        else
          umls<QuadraticWeight>(*this->mesh, n, points, options, lists);
      }

      UmlsOptions options;
      bool        is_cubic = true;

    private:
      std::string weight = "cubic", support = "local";
    };

    /** Continuously differentiable weights and their true gradients; see c1_umls(). */
    template <int dim>
    class C1Umls : public Umls<dim>
    {
    public:
      using Umls<dim>::Umls;

      /** Gradients are of the order of the root of a small weight, and both are exact down to squares of round-off. */
      double smallest_share() const override { return 1e-34; }

    private:
      void find(const unsigned int n, const MeshPoint<dim> *points, Stencil<dim> *lists) const override
      {
        if (this->is_cubic)
          c1_umls<CubicWeight>(*this->mesh, n, points, this->options, lists);
        else
          c1_umls<QuadraticWeight>(*this->mesh, n, points, this->options, lists);
      }
    };

    const RegisterDimensions<Kernel, P1>     p1_kernel("P1", "linear functions on triangles or tetrahedra");
    const RegisterDimensions<Kernel, Umls>   umls_kernel("UMLS", "moving least squares on triangles or tetrahedra");
    const RegisterDimensions<Kernel, C1Umls> c1_kernel(
      "C1 UMLS", "the same with weights that are continuously differentiable, and true gradients");
  } // namespace
} // namespace Talus
