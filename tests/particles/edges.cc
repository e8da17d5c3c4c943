#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  std::string edge_text(const std::string &body)
  {
    return section("Grid", set("Upper corner", coordinates<dim>({{2, 2, 2}})) + set("Spacing", "0.125")) +
           body_text(body);
  }

  template <int dim>
  std::string shifted_ball(const double radius, const std::array<double, 3> &offset, const std::string &more = "")
  {
    return set("Shape", "ball") + set("Centre", coordinates<dim>({{1.01, 0.97, 1.02}})) +
           set("Radius", std::to_string(radius)) + set("Lattice offset", coordinates<dim>(offset)) + more;
  }

  /** Sums over all particles of volume, and of volume times the place from `centre`. */
  template <int dim>
  std::pair<double, Tensor<1, dim>> moments(const Setup<dim> &setup, const Point<dim> &centre)
  {
    std::pair<double, Tensor<1, dim>> result;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
    {
      const double V = setup.particles.component(setup.particles.volume, 0)[p];
      result.first += V;
      result.second += V * (setup.position(p) - centre);
    }
    result.first  = sum(result.first);
    result.second = Utilities::MPI::sum(result.second, MPI_COMM_WORLD);
    return result;
  }
} // namespace

/** Mass of curved shapes with volumes sampled at the edge: to 1 % from a radius of 1.5 spacings on. */
template <int dim>
void edge_volumes()
{
  const double pi = numbers::PI;
  Point<dim>   centre;
  const double place[3] = {1.01, 0.97, 1.02};
  for (unsigned int d = 0; d < dim; ++d)
    centre[d] = place[d];
  double greatest = 0, eccentric = 0, whole = 0;
  for (const double r : {1.5, 1.7, 2., 2.6, 3.3, 5.})
    for (const int n : {1, 2, 3})
      for (const double offset : {0., 0.3, -0.5, 0.9})
      {
        const double      R    = r * 0.125;
        const std::string more = set("Particles per cell and direction", std::to_string(n));
        const double      V    = dim == 2 ? pi * R * R : 4. / 3 * pi * R * R * R;
        Setup<dim>        setup(edge_text<dim>(shifted_ball<dim>(R, {{offset, -offset / 2, 0}}, more)));
        const auto        m = moments(setup, centre);
        raise(greatest, m.first / V - 1);
        if (offset == 0)
          raise(eccentric, m.second.norm() / (V * R));
        Setup<dim> boxes(
          edge_text<dim>(shifted_ball<dim>(R, {{offset, -offset / 2, 0}}, more + set("Edge volumes", "whole"))));
        raise(whole, moments(boxes, centre).first / V - 1);
        check_true("the same particles, radius " + std::to_string(r),
                   setup.particles.n_global == boxes.particles.n_global);
        if (dim == 3 && n == 2)
        {
          const std::string base = set("Shape", "cylinder") + set("Centre", "1.01, 0.97, 0.3") + set("Axis", "z") +
                                   set("Radius", std::to_string(R)) + set("Height", "0.5");
          Setup<dim> cylinder(edge_text<dim>(base + set("Lattice offset", coordinates<dim>({{offset, offset, 0}}))));
          raise(greatest, moments(cylinder, centre).first / (pi * R * R * 0.5) - 1);
        }
      }
  check("volume", greatest, 0.01);
  check("centre of gravity off the centre", eccentric, 1e-12);
  check_true("whole boxes are farther off", whole > 0.05);
}

/** A shifted lattice loses no row: the volume stays, and a whole spacing is no shift at all. */
template <int dim>
void shifted_lattices()
{
  Setup<dim> first(edge_text<dim>(shifted_ball<dim>(0.5, {{0, 0, 0}})));
  for (const double shift : {1., -1.})
  {
    Setup<dim> setup(edge_text<dim>(shifted_ball<dim>(0.5, {{shift, 0, shift}})));
    check_true("ball by a whole row", setup.particles.n_global == first.particles.n_global);
  }
  for (const double shift : {0.25, 0.75, -0.4})
  {
    const std::string corners = set("Lower corner", coordinates<dim>({{0.5, 0.5, 0.5}})) +
                                set("Upper corner", coordinates<dim>({{1, 1.25, 0.75}}));
    Setup<dim> box(edge_text<dim>(corners + set("Lattice offset", coordinates<dim>({{shift, 0, -shift}}))));
    check("box", moments(box, Point<dim>()).first / (0.375 * (dim == 2 ? 1 : 0.25)) - 1, 1e-12);
  }
}

#define INSTANTIATE(name)                                                                                              \
  template void name<2>();                                                                                             \
  template void name<3>();
INSTANTIATE(edge_volumes)
INSTANTIATE(shifted_lattices)
