#include <talus/boundary/condition.h>
#include <talus/core/exceptions.h>
#include <talus/core/function.h>
#include <talus/core/registry.h>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** Velocity as a function of place and time, for some or all components. */
    template <int dim>
    class Velocity : public Condition<dim>
    {
    public:
      explicit Velocity(const std::string &section) :
        Condition<dim>(section), text(dim == 2 ? "0; 0" : "0; 0; 0"), components(dim == 2 ? "x, y" : "x, y, z")
      {
        this->add_parameter("Velocity", text, "Velocity [length/time]: functions of x, y, z, t, separated by ';'.");
        this->add_parameter("Components", components, "Which components are prescribed.", this->prm,
                            Patterns::List(Patterns::Selection(dim == 2 ? "x|y" : "x|y|z"), 1, dim));
      }

      void parse_parameters(ParameterHandler &prm) override
      {
        Condition<dim>::parse_parameters(prm);
        velocity.initialize(text, this->get_section_name(), "Velocity");
        for (unsigned int d = 0; d < dim; ++d)
          is_prescribed[d] = components.find("xyz"[d]) != std::string::npos;
      }

    private:
      void prescribe(const double time, Grid<dim> &grid) override
      {
        Tensor<1, dim> v = velocity.value({}, time);
        for (const auto &list : this->nodes)
          for (const unsigned int i : list)
          {
            if (velocity.depends_on_space())
              v = velocity.value(grid.node_position(i), time);
            for (unsigned int d = 0; d < dim; ++d)
              if (is_prescribed[d])
                this->set(grid.fields[i], d, v[d]);
          }
      }

      ParsedVector<dim>     velocity;
      std::string           text, components;
      std::array<bool, dim> is_prescribed;
    };

    /** Nodes stay where they are. */
    template <int dim>
    class NoSlip : public Condition<dim>
    {
    public:
      using Condition<dim>::Condition;

    private:
      void prescribe(const double, Grid<dim> &grid) override
      {
        for (const auto &list : this->nodes)
          for (const unsigned int i : list)
            for (unsigned int d = 0; d < dim; ++d)
              this->set(grid.fields[i], d, 0.);
      }
    };

    /** Nodes do not move along the normal of their face. */
    template <int dim>
    class Slip : public Condition<dim>
    {
    public:
      using Condition<dim>::Condition;

      void parse_parameters(ParameterHandler &prm) override
      {
        Condition<dim>::parse_parameters(prm);
        if (this->boundary_ids.empty())
          throw EntryError(this->get_section_name(), "Boundary ids",
                           "slip needs the faces whose normals it acts along. A box of nodes has none.");
      }

    private:
      void prescribe(const double, Grid<dim> &grid) override
      {
        for (unsigned int f = 0; f < this->boundary_ids.size(); ++f)
          for (const unsigned int i : this->nodes[f])
            this->set(grid.fields[i], this->boundary_ids[f] / 2, 0.);
      }
    };

    const RegisterDimensions<Condition, Velocity> velocity("velocity", "velocity as a function of place and time");
    const RegisterDimensions<Condition, NoSlip>   no_slip("no-slip", "nodes are fixed");
    const RegisterDimensions<Condition, Slip>     slip("slip", "no motion along the normal of a face");
  } // namespace
} // namespace Talus
