#include "../setup.h"

#include <map>

using namespace Test;
using namespace dealii;

namespace
{
  template <int dim>
  std::string model(const double lower, const std::string &body)
  {
    const std::string grid = set("Lower corner", coordinates<dim>({{lower, lower, lower}})) +
                             set("Upper corner", coordinates<dim>({{1, 1, 1}})) + set("Spacing", "0.125");
    return section("Grid", grid) + body_text(body);
  }

  /** Place and mass by id, of all ranks. */
  template <int dim>
  std::map<unsigned int, std::pair<Point<dim>, double>> particles_of(const Setup<dim> &setup)
  {
    std::map<unsigned int, std::pair<Point<dim>, double>> mine, all;
    for (unsigned int p = 0; p < setup.particles.size(); ++p)
      mine[setup.particles.id[p]] = {Point<dim>(setup.position(p)),
                                     setup.particles.component(setup.particles.mass, 0)[p]};
    for (const auto &of_rank : Utilities::MPI::all_gather(MPI_COMM_WORLD, mine))
      all.insert(of_rank.begin(), of_rank.end());
    return all;
  }
} // namespace

/**
 * A body about the origin in a grid that begins there is what the whole model has in it: the same ids at the same
 * places with the same masses, half of a particle on each face. Together the parts are the whole: 2^dim times the mass.
 */
template <int dim>
void clipped()
{
  const std::string clip = set("Clip to grid", "true"), origin = set("Centre", coordinates<dim>({{0, 0, 0}}));
  // An even and an odd number of rows: the second has a row on each face.
  for (const auto &[name, body] : std::vector<std::pair<std::string, std::string>>{
         {"ball, even", set("Shape", "ball") + origin + set("Radius", "0.75")},
         {"ball, odd", set("Shape", "ball") + origin + set("Radius", "0.78125")},
         {"box, odd", set("Lower corner", coordinates<dim>({{-0.65625, -0.65625, -0.65625}})) +
                        set("Upper corner", coordinates<dim>({{0.65625, 0.65625, 0.65625}}))}})
  {
    Setup<dim>   whole(model<dim>(-1, body)), part(model<dim>(0, body + clip));
    const auto   all = particles_of(whole), some = particles_of(part);
    double       mass = 0, places = 0, masses = 0;
    unsigned int n = 0, n_on_faces = 0, n_wrong = 0;
    for (const auto &[id, particle] : all)
    {
      mass += particle.second;
      double share = 1;
      for (unsigned int d = 0; d < dim; ++d)
        share *= particle.first[d] > 1e-12 ? 1 : particle.first[d] < -1e-12 ? 0 : 0.5;
      const auto found = some.find(id);
      n_wrong += (found == some.end()) != (share == 0);
      if (share == 0 || found == some.end())
        continue;
      ++n;
      n_on_faces += share < 1;
      raise(places, found->second.first.distance(particle.first));
      raise(masses, found->second.second - share * particle.second);
      mass -= (1 << dim) * found->second.second;
    }
    check_true(name + ": what lies outside is left out", n_wrong == 0);
    check_true(name + ": nothing else", n == some.size() && part.particles.n_global == n);
    check_true(name + ": on the faces", (n_on_faces > 0) == (name.find("odd") != std::string::npos));
    check(name + ": places", places, 1e-15);
    check(name + ": masses", masses, 1e-16);
    check(name + ": mass of the whole", mass, 1e-12);
  }

  // A load on the surface is cut as well: the parts of a circle lie in one quarter or in the next, one of about 19.
  const std::string load =
    section("Tractions", set("Names", "pull") + section("pull", set("Traction", dim == 2 ? "1; 0" : "1; 0; 0")));
  const std::string sphere = set("Shape", "ball") + origin + set("Radius", "0.75");
  double            force[2];
  for (const bool is_part : {false, true})
  {
    Setup<dim> setup(model<dim>(is_part ? 0 : -1, sphere + (is_part ? clip : "")) + load);
    setup.scatter();
    setup.tractions.apply(setup.particles, *setup.kernel, 0., setup.grid);
    force[is_part] = sum(setup.tractions.loads[0]->force[0]);
  }
  check("load", (1 << dim) * force[1] / force[0] - 1, 1. / 17);

  check_error<EntryError>("nothing left", {"/Bodies/body: Centre", "empty"}, [&] {
    Setup<dim> s(model<dim>(0, set("Shape", "ball") + set("Centre", coordinates<dim>({{-0.5, -0.5, -0.5}})) +
                                 set("Radius", "0.25") + clip));
  });
  check_error<EntryError>("not asked for", {"/Bodies/body: Centre", "outside the grid", "Clip to grid"},
                          [&] { Setup<dim> s(model<dim>(0, sphere)); });
}

template void clipped<2>();
template void clipped<3>();
