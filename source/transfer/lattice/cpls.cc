#include <talus/core/exceptions.h>
#include <talus/core/registry.h>
#include <talus/grid/box_grid.h>
#include <talus/particles/lattice/corners.h>
#include <talus/transfer/flip.h>
#include <talus/transfer/lattice/imls_domains.h>

namespace Talus
{
  namespace
  {
    /**
     * CPLS, Tran, Solowski, Berzins & Guilkey (2019): mass and forces by CPDI, the nodes' velocities by improved moving
     * least squares over the particles' centres and corners, there v_c = v_p + grad v_p (x_c - x_p). Then FLIP.
     *
     * The projection does not conserve momentum. With two particles a cell and direction, nodes have that of the
     * particles and, to leading order, C h^2 times the integral of rho laplace(v) more, C = .2354 in 2D and .2326 in
     * 3D; particles, which receive forces alone, keep theirs. In impacts with small steps it gains energy: two disks,
     * which lose 4.2 % and 2.0 % with dt sqrt(E / rho) / h = .2 and .1, gain 1.0 %, 4.0 % and 6.4 % with .05, .025 and
     * .0125 (CPDI loses 4.7, 3.9, 2.9, 1.9 and 1.2 %). Smooth motion does not: doc/cpls.md. Test:
     * tests/transfer/cpls.cc.
     */
    template <int dim>
    class Cpls : public AffineTransfer<dim, Flip>
    {
    public:
      explicit Cpls(const std::string &section) : AffineTransfer<dim, Flip>(section)
      {
        this->add_parameter("Basis", basis,
                            "Functions of the fit. Linear ones are the method; quadratic ones fit smooth fields better "
                            "and are unstable in dynamics.",
                            this->prm, dealii::Patterns::Selection("linear|quadratic"));
      }

      void add_fields(WorkingSet<dim> &particles) override { half_edges = Corners<dim>::add_field(particles); }

      Reach reach(const Kernel<dim> &kernel) const override
      {
        const Reach of_kernel = kernel.reach();
        if (!of_kernel.at_corners)
          throw EntryError(this->get_section_name(), "Type",
                           "CPLS fits velocities at the corners of particle domains. Set 'Type = CPDI' in section "
                           "'Kernel'.");
        return {CubicBSpline::n, CubicBSpline::shift, /* at_corners = */ true, of_kernel.layers + 1};
      }

      void particle_to_grid(const WorkingSet<dim> &particles, const Kernel<dim> &kernel,
                            const BodyForce<dim> &acceleration, const double time, Grid<dim> &grid) override
      {
        AffineTransfer<dim, Flip>::particle_to_grid(particles, kernel, acceleration, time, grid);
        if (basis == "linear")
          scatter(particles, grid, linear);
        else
          scatter(particles, grid, quadratic);
      }

      void complete(Grid<dim> &grid) override
      {
        if (basis == "linear")
          set_velocity(linear, grid);
        else
          set_velocity(quadratic, grid);
      }

    private:
      using Number  = Simd<native_width>;
      using Vector  = dealii::Tensor<1, dim, Number>;
      using Domains = ImlsDomains<dim, 1 + Corners<dim>::n>;

      /** The centre and the corners of each particle with their velocities. */
      template <class Fit>
      void scatter(const WorkingSet<dim> &particles, const Grid<dim> &grid, Fit &fit) const
      {
        const auto        &lattice = box_grid(grid, "/Transfer", "Type").lattice;
        const Corners<dim> corners(particles, half_edges);
        const auto         v = particles.template components<dim>(particles.velocity);
        const auto         L = particles.template components<dim * dim>(particles.grad_v);
        Domains            domains;
        fit.clear(grid);
        for_each_batch(0, particles.size(), [&](const auto batch) {
          const auto x     = corners.position(batch);
          const auto r     = corners.half_edges(batch);
          domains.value    = load_vector<dim>(batch, v);
          domains.gradient = load_matrix<dim>(batch, L);
          domains.point[0] = corners.coordinates(lattice, x);
          for (unsigned int c = 0; c < corners.n; ++c)
            domains.point[1 + c] = corners.coordinates(lattice, x + corners.arm(r, c));
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int a = 0; a < dim; ++a)
              domains.gradient[d][a] *= lattice.h[a];
          add(domains, batch.size(), lattice, fit);
        });
      }

      static void add(Domains &domains, const unsigned int size, const Lattice<dim> &lattice, Imls<dim, 1> &fit)
      {
        if (domains.find(lattice, size))
          domains.add(lattice, fit.numbers());
        else
          add_points(domains, size, lattice, fit);
      }

      static void add(Domains &domains, const unsigned int size, const Lattice<dim> &lattice, Imls<dim, 2> &fit)
      {
        add_points(domains, size, lattice, fit);
      }

      /** Whatever the basis, one datum after the other. */
      template <class Fit>
      static void add_points(const Domains &domains, const unsigned int size, const Lattice<dim> &lattice, Fit &fit)
      {
        for (const Vector &point : domains.point)
        {
          const Vector value = domains.value + domains.gradient * (point - domains.point[0]);
          for (unsigned int l = 0; l < size; ++l)
          {
            double                 at[dim];
            dealii::Tensor<1, dim> v;
            for (unsigned int d = 0; d < dim; ++d)
            {
              at[d] = point[d].data()[l];
              v[d]  = value[d].data()[l];
            }
            fit.add(lattice, at, v);
          }
        }
      }

      template <class Fit>
      static void set_velocity(Fit &fit, Grid<dim> &grid)
      {
        fit.collect();
        for (const unsigned int i : grid.active_nodes)
        {
          double      *node = grid.fields[i];
          const double m    = node[NodalFields<dim>::mass];
          if (!(m > grid.mass_floor))
            continue;
          const auto v_i = fit.value(i);
          for (unsigned int d = 0; d < dim; ++d)
            node[NodalFields<dim>::momentum + d] = m * v_i[d];
        }
      }

      std::string  basis      = "linear";
      unsigned int half_edges = 0;
      Imls<dim, 1> linear;
      Imls<dim, 2> quadratic;
    };

    const RegisterDimensions<Transfer, Cpls> registration(
      "CPLS",
      "moving least squares over CPDI domains, then FLIP; the nodes' momentum is off by .23 h^2 times the integral of rho "
      "laplace(v), and impacts with small steps gain energy: 1 % with dt sqrt(E/rho)/h = .05, 6 % with .0125");
  } // namespace
} // namespace Talus
