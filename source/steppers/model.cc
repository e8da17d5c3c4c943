#include <talus/core/exceptions.h>
#include <talus/core/memory.h>
#include <talus/grid/simplex_grid.h>
#include <talus/steppers/model.h>

#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::unique_ptr<Grid<dim>> make_grid(Parameters &parameters, const Communicator &communicator)
    {
      const std::string section = "/Grid";
      if (parameters.choose_from(section, "Type", "box", "box|mesh",
                                 "box: equal cells; mesh: triangles or tetrahedra.") == "box")
        return std::make_unique<BoxGrid<dim>>(section, communicator);
      return std::make_unique<SimplexGrid<dim>>(section, communicator);
    }
  } // namespace

  template <int dim>
  Model<dim>::Model(Parameters &parameters, const Communicator &communicator) :
    ParameterAcceptor("/Run"), own_grid(make_grid<dim>(parameters, communicator)), grid(*own_grid),
    kernel(parameters.make<Kernel<dim>>("/Kernel", "Type", "quadratic B-spline", "Kernel function.")),
    transfer(
      parameters.make<Transfer<dim>>("/Transfer", "Type", "TPIC", "Scheme that carries motion to the grid and back.")),
    smoothing(parameters), acceleration_text(dim == 2 ? "0; 0" : "0; 0; 0")
  {
    kernel->choose(parameters);
    build_bodies(parameters);
    build_conditions(parameters);
    kernel->add_fields(particles);
    transfer->add_fields(particles);
    transfer->is_plain =
      parameters.choose_from("/Run", "Loops", "batched", "batched|plain",
                             "batched: many particles at a time; plain: one, the slow reference of the others.") ==
      "plain";
    add_parameter("Body force", acceleration_text,
                  "Force per mass [length/time^2], for instance gravity: functions of x, y, z, t, separated by ';'.");
    add_parameter("Local damping", boundary.damping.factor,
                  "Share alpha of each nodal force that opposes the motion, for quasi-static work [1]; 0: none.", prm,
                  Patterns::Double());
    add_parameter("F-bar", f_bar.is_on,
                  "Materials see volumes that are averaged over the grid, against volumetric locking.");
    add_parameter("F-bar averages", f_bar.n_passes,
                  "How often volumes are averaged: one leaves 15 % of a wave of two spacings with quadratic B-splines, "
                  "two leave 2 %.",
                  prm, Patterns::Integer(1, 10));
    add_parameter("Energy account", account.is_on,
                  "Statistics say what transfer, walls, friction and plastic flow have taken of the energy.");
  }

  template <int dim>
  void Model<dim>::build_bodies(Parameters &parameters)
  {
    material_names = parameters.names("/Materials", "Names of the materials; each has a subsection of its name.");
    const auto body_names = parameters.names("/Bodies", "Names of the bodies; each has a subsection of its name.");
    AssertThrow(!material_names.empty() || body_names.empty(),
                EntryError("/Materials", "Names", "give at least one material."));
    for (const auto &name : material_names)
    {
      materials.push_back(
        parameters.make<Material>("/Materials/" + name, "Type", "linear elastic", "Constitutive law."));
      particles.add_states(materials.back()->state_names());
    }
    for (const auto &name : body_names)
      bodies.push_back(std::make_unique<Body<dim>>(parameters, name, material_names));
  }

  template <int dim>
  void Model<dim>::build_conditions(Parameters &parameters)
  {
    boundary.names = parameters.names("/Conditions", "Names of the conditions in the order in which they act.");
    for (const auto &name : boundary.names)
      boundary.conditions.push_back(
        parameters.make<Condition<dim>>("/Conditions/" + name, "Type", "no-slip", "Kind of condition."));

    for (const auto &name :
         parameters.names("/Obstacles", "Names of the obstacles; each has a subsection of its name."))
      boundary.obstacles.push_back(std::make_unique<Obstacle<dim>>(parameters, name));

    std::vector<std::string> body_names;
    for (const auto &body : bodies)
      body_names.push_back(body->name);
    tractions.names = parameters.names("/Tractions", "Names of the tractions; each has a subsection of its name.");
    for (const auto &name : tractions.names)
      tractions.loads.push_back(std::make_unique<Traction<dim>>(parameters, name, body_names));
    contacts.build(parameters);
  }

  template <int dim>
  void Model<dim>::parse_parameters(ParameterHandler &)
  {
    acceleration.initialize(acceleration_text, get_section_name(), "Body force");
    if (!(boundary.damping.factor >= 0 && boundary.damping.factor < 1))
      throw EntryError(get_section_name(), "Local damping",
                       "it must lie between 0 and 1, 1 excluded; 0.7 comes to rest soon.");
    for (unsigned int m = 0; m < materials.size(); ++m)
      if (f_bar.is_on && materials[m]->smoothing_speed() > 0)
        throw EntryError(get_section_name(), "F-bar",
                         "it averages volumes, and 'J smoothing' of '" + material_names[m] +
                           "' too. Choose one of them.");
  }

  template <int dim>
  void Model<dim>::create(const std::function<void()> &initialize)
  {
    for (const auto &body : bodies)
    {
      if (transfer->reach(*kernel).at_corners && materials[body->material]->carries_volume_only())
        throw EntryError("/Kernel", "Type",
                         "the domains of '" + body->name +
                           "' would follow its deformation gradient, and a fluid has "
                           "none. Take a B-spline.");
      body->shape->create(grid.spacing);
    }
    for (const auto &material : materials)
      material->set_spacing(grid.largest_spacing);
    check_memory();
    const Reach reach = transfer->reach(*kernel);
    grid.create([&](const auto &cell) { return Particles<dim>::count(grid, bodies, cell); }, reach);
    attach();
    smoothing.add_fields(materials, particles);
    f_bar.add_fields(particles);
    if (!bodies.empty())
    {
      particles.create(grid, bodies, materials, kernel->smallest_share());
      overlaps.check(particles, bodies, grid);
    }
    boundary.attach(grid);
    boundary.mark_slip_walls(std::numeric_limits<double>::min(), particles.n_stencil_nodes, grid);
    initialize();
    transfer->initialize(*kernel, particles);
    smoothing.initialize(materials, *kernel, particles, grid);
    f_bar.initialize(particles);
    for (const auto &body : bodies)
      if (body->starts_deformed() && materials[body->material]->starts_deformed())
        materials[body->material]->update(material_range(particles, body->material, /* dt = */ 0.));
    for (auto &traction : tractions.loads)
      traction->attach(grid, bodies, particles);
    contacts.attach(grid, materials, particles);
  }

  template <int dim>
  void Model<dim>::attach()
  {
    const Reach reach = transfer->reach(*kernel);
    kernel->attach(grid);
    if (reach.ghosts)
      walls.attach(box_grid(grid, "/Kernel", "Boundary treatment"));
    particles.set_reach(grid, reach);
  }

  template <int dim>
  void Model<dim>::repartition(const std::vector<double> &counts)
  {
    // What conditions know of nodes goes by their positions.
    Archive of_nodes;
    boundary.serialize(of_nodes, grid);
    Archive::Numbers of_all;
    for (const auto &[name, numbers] : of_nodes.all_of_rank())
      for (const auto &of_rank : Utilities::MPI::all_gather(grid.communicator, numbers))
        of_all[name].insert(of_all[name].end(), of_rank.begin(), of_rank.end());

    grid.repartition(counts);
    last_counts = counts;
    attach();
    boundary.attach(grid);
    particles.find_places();
    Archive found(of_nodes.all_shared(), of_all, /* is_exact = */ false);
    boundary.serialize(found, grid);
  }

  template <int dim>
  void Model<dim>::move_nodes(const double time, const double dt)
  {
    grid.fields.add_copies_to_owners();
    walls.collect();
    transfer->complete(grid);
    account.start(grid, walls);
    if (walls.has_ghosts())
      boundary.solve(time + dt, dt, walls, grid);
    else
    {
      grid.update_velocity(dt);
      boundary.apply(time + dt, dt > 0 ? dt : 1., grid);
    }
    grid.fields.update_copies();
    walls.fill();
    account.finish(dt, grid, walls);
  }

  template <int dim>
  std::optional<double> Model<dim>::lone_particle_limit(const std::array<double, 2> &factors) const
  {
    const auto greatest = kernel->greatest_stiffness(factors[0], factors[1]);
    if (!greatest)
      return {};
    double sum = 0;
    for (unsigned int d = 0; d < dim; ++d)
      sum += std::pow(grid.smallest_spacing * grid.inverse_spacing[d], 2);
    return 1 / std::sqrt(*greatest * sum);
  }

  template <int dim>
  double Model<dim>::material_factor() const
  {
    double most = 0; // l / (l + 2 G)
    for (const auto &material : materials)
      most = std::max(most, material->rest_stress_ratio());
    return std::sqrt(dim / (1 + (dim - 1) * most));
  }

  template <int dim>
  void Model<dim>::check_memory() const
  {
    // A body fills a third of the box around it at least, and particles take what they carry.
    double      n = 0, most = 0;
    std::string section, entry;
    for (const auto &body : bodies)
    {
      const double here = body->shape->n_indices();
      n += here;
      if (here > most)
      {
        most    = here;
        section = body->get_section_name();
        entry   = body->shape->density_entry();
      }
    }
    const double wanted = n / 3 * particles.n_columns() * sizeof(double), has = physical_memory(grid.communicator);
    std::ostringstream text;
    text << std::setprecision(3) << "the particles of all bodies, up to " << n << " of them, take " << wanted / 1e9
         << " GB at least, and there are " << has / 1e9
         << " GB of memory. Take fewer, a larger spacing or smaller bodies.";
    if (wanted > has)
      throw EntryError(section, entry, text.str());
  }

  template <int dim>
  void Model<dim>::serialize(Archive &archive)
  {
    archive.of_rank("partition", last_counts);
    if (archive.is_reading() && Utilities::MPI::this_mpi_process(grid.communicator) != 0 && !archive.is_exact())
      last_counts.clear(); // the first rank has those of all
    std::vector<double> first_ids;
    for (const auto &body : bodies)
      first_ids.push_back(body->first_id);
    archive("first ids", first_ids); // for a stage with other bodies
    grid.serialize(archive);
    if (archive.is_reading())
    {
      particles.update_open_places();
      boundary.select(grid);
    }
    walls.serialize(archive);
    boundary.serialize(archive, grid);
    contacts.serialize(archive);
  }

  template <int dim>
  void Model<dim>::add_to(Reduction &reduction)
  {
    requests.add_to(reduction);
    reduction.sum(grid.lost_momentum);
    boundary.add_to(reduction);
    tractions.add_to(reduction);
    contacts.add_to(reduction);
    account.add_to(reduction);
  }

  template <int dim>
  std::string Model<dim>::summary() const
  {
    const auto chosen = [](const std::string &section, const std::string &entry) {
      prm.enter_subsection(section);
      const std::string value = prm.get(entry);
      prm.leave_subsection();
      return value;
    };
    std::ostringstream text;
    text << "  grid       " << grid.summary() << ", " << grid.dof_handler.n_dofs() << " nodes\n  particles  "
         << particles.n_global << " in " << bodies.size()
         << (bodies.size() == 1 ? " body\n" : " bodies, which share one velocity field: they stick on contact\n")
         << "  kernel     " << chosen("Kernel", "Type")
         << (kernel->product_form() ? ", boundary treatment " + chosen("Kernel", "Boundary treatment") : "")
         << "\n  transfer   " << chosen("Transfer", "Type") << '\n';
    return text.str();
  }

  template class Model<2>;
  template class Model<3>;
} // namespace Talus
