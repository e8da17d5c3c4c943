#include <talus/boundary/condition.h>
#include <talus/boundary/friction_accounts.h>
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
        this->for_each_node([&](const unsigned int i) {
          if (velocity.depends_on_space())
            v = velocity.value(grid.node_position(i), time);
          for (unsigned int d = 0; d < dim; ++d)
            if (is_prescribed[d])
              this->set(i, d, v[d]);
        });
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
        this->for_each_node([&](const unsigned int i) {
          for (unsigned int d = 0; d < dim; ++d)
            this->set(i, d, 0.);
        });
        this->take_mirrored(grid);
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
        if (this->faces.empty() && this->boundaries.empty())
          throw EntryError(this->get_section_name(), "Boundary ids",
                           "slip needs the faces or half spaces whose normals it acts along. A box of nodes has none.");
      }

      bool is_slip() const override { return true; }

    private:
      /** Stops a node along the normal. */
      virtual void stop(const unsigned int i, const unsigned int axis) { this->set(i, axis, 0.); }
      virtual void stop(const unsigned int i, const Tensor<1, dim> &n) { this->set(i, n, 0.); }

      void prescribe(const double, Grid<dim> &grid) override
      {
        for (const auto &part : this->parts)
          for (unsigned int k = 0; k < part.nodes.size(); ++k)
            for (const auto &n : part.basis[k])
              stop(part.nodes[k], n);
        this->take_mirrored(grid);
        for (unsigned int f = 0; f < this->faces.size(); ++f)
        {
          const unsigned int id = this->faces[f];
          for (const unsigned int i : this->nodes[f])
            stop(i, id / 2);
          if (f >= this->boundary_ids.size())
            continue; // planes inside the grid mirror nothing
          this->take_mirrored(id, grid);
        }
      }
    };

    /**
     * A plane of symmetry: along its normal velocities *and accelerations* of nodes at it and beyond are zero. What
     * particles on one side alone bring to such a node is of the order of the spacing and no velocity of the plane;
     * slip hands its loss to transfers that carry increments (FLIP, CPLS), which costs half an order at the plane.
     * Test: tests/boundary/conditions.cc; tests/regression/verification.py.
     */
    template <int dim>
    class Symmetry : public Slip<dim>
    {
    public:
      using Slip<dim>::Slip;

    private:
      void stop(const unsigned int i, const unsigned int axis) override { this->arrest(i, axis); }
      void stop(const unsigned int i, const Tensor<1, dim> &n) override { this->arrest(i, n); }
    };

    /**
     * Coulomb friction on faces of the grid's box. A node that presses against a face loses the normal part of its
     * velocity relative to the wall, and of the tangential part at most mu times as much:
     * @f[ \Delta v_t = -\min(\mu \, \Delta v_n, |v_t|) \, v_t / |v_t| . @f]
     * One that moves away is free. Test: tests/boundary/conditions.cc, tests/loads (a block on an incline).
     */
    template <int dim>
    class Friction : public Condition<dim>
    {
    public:
      explicit Friction(const std::string &section) : Condition<dim>(section), wall_text(dim == 2 ? "0; 0" : "0; 0; 0")
      {
        this->add_parameter("Friction coefficient", mu, "Greatest tangential over normal force, mu [1].", this->prm,
                            Patterns::Double());
        this->add_parameter("Wall velocity", wall_text,
                            "Velocity of the wall [length/time]: functions of x, y, z, t, separated by ';'.");
        this->add_parameter(
          "Account time", account_time,
          "How long a node may use normal impulse that friction has not used, so that it sticks through "
          "vibrations [time]; 0: that of the step alone.",
          this->prm, Patterns::Double(0));
      }

      void keep(const unsigned int node, const unsigned int axis,
                const typename Prescribed<dim>::Contact &contact) override
      {
        accounts.keep(node, axis, {{contact.account, contact.mean}});
      }

      void serialize(Archive &archive, const Grid<dim> &grid) override
      {
        std::vector<const std::vector<unsigned int> *> nodes;
        for (const auto &list : this->owned_nodes())
          nodes.push_back(&list);
        accounts.serialize(archive, grid, nodes);
      }

      void forget() override { accounts.forget(); }

      void parse_parameters(ParameterHandler &prm) override
      {
        Condition<dim>::parse_parameters(prm);
        wall.initialize(wall_text, this->get_section_name(), "Wall velocity");
        if (this->faces.empty() && this->boundaries.empty())
          throw EntryError(this->get_section_name(), "Boundary ids",
                           "friction needs the faces or half spaces whose normals press. A box of nodes has none.");
        if (!(mu >= 0))
          throw EntryError(this->get_section_name(), "Friction coefficient",
                           "it must not be negative; 0 is a wall without friction.");
      }

      /** A wall stays where it is: what moves along its normal is no face of the grid, and no plane. */
      void check_before_start(const Grid<dim> &grid, const double end_time) const override
      {
        // Looked at here and there, and now and then: what moves does so everywhere, or nearly so.
        double             worst   = 0;
        const unsigned int n_times = wall.depends_on_space() ? 11 : 101, n_places = wall.depends_on_space() ? 100 : 1;
        for (unsigned int f = 0; f < this->faces.size(); ++f)
        {
          const auto        &list = this->owned_nodes()[f];
          const unsigned int step = list.size() / n_places + 1;
          for (unsigned int i = 0; i < list.size(); i += step)
            for (unsigned int k = 0; k < n_times; ++k)
            {
              const auto v = wall.value(grid.node_position(list[i]), end_time * k / (n_times - 1));
              worst        = std::max(worst, std::abs(v[this->faces[f] / 2]));
            }
        }
        if (Utilities::MPI::max(worst, grid.communicator) > 0)
          throw EntryError(
            this->get_section_name(), "Wall velocity",
            "a wall cannot move along its normal, it stays where the grid or the plane is. Set that component "
            "to 0; to push a body, take a condition of type 'velocity' on a box of nodes.");
      }

    private:
      void prescribe(const double time, Grid<dim> &grid) override
      {
        Tensor<1, dim> v_wall = wall.value({}, time);
        accounts.begin_step();
        for (unsigned int f = 0; f < this->faces.size(); ++f)
        {
          Tensor<1, dim> n;
          n[this->faces[f] / 2] = this->faces[f] % 2 == 0 ? -1 : 1;
          for (const unsigned int i : this->nodes[f])
          {
            if (!this->prescribed)
            {
              rub(i, n, time, v_wall, grid);
              continue;
            }
            if (wall.depends_on_space())
              v_wall = wall.value(grid.node_position(i), time);
            const unsigned int axis    = this->faces[f] / 2;
            auto              &contact = this->prescribed->press(i, axis, n[axis], mu, v_wall);
            contact.account_time       = account_time;
            if (const auto *account = accounts.of(i, axis))
            {
              contact.account = (*account)[0];
              contact.mean    = (*account)[1];
            }
          }
        }
        for (const auto &part : this->parts)
          for (unsigned int k = 0; k < part.nodes.size(); ++k)
            for (const auto &n : part.normals[k])
              rub(part.nodes[k], n, time, v_wall, grid);
      }

      /** A node against a face with outward normal n. */
      void rub(const unsigned int i, const Tensor<1, dim> &n, const double time, Tensor<1, dim> &v_wall,
               const Grid<dim> &grid)
      {
        using Fields = NodalFields<dim>;
        if (wall.depends_on_space())
          v_wall = wall.value(grid.node_position(i), time);
        Tensor<1, dim> slip;
        for (unsigned int d = 0; d < dim; ++d)
          slip[d] = grid.fields[i][Fields::velocity + d] - v_wall[d];
        const double approach = n * slip;
        if (!(approach > 0))
          return;
        slip -= approach * n;
        const double speed = slip.norm();
        slip *= speed > mu * approach ? 1 - mu * approach / speed : 0;
        for (unsigned int d = 0; d < dim; ++d)
          this->set(i, d, v_wall[d] + slip[d]);
      }

      ParsedVector<dim>     wall;
      std::string           wall_text;
      double                mu = 0, account_time = 0;
      FrictionAccounts<dim> accounts;
    };

    const RegisterDimensions<Condition, Velocity> velocity("velocity", "velocity as a function of place and time");
    const RegisterDimensions<Condition, NoSlip>   no_slip("no-slip", "nodes are fixed");
    const RegisterDimensions<Condition, Slip>     slip("slip", "no motion along the normal of a face");
    const RegisterDimensions<Condition, Symmetry> symmetry("symmetry", "no motion and no acceleration along a normal");
    const RegisterDimensions<Condition, Friction> friction("friction", "Coulomb friction on a face, free to lift off");
  } // namespace
} // namespace Talus
