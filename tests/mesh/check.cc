#include "../check.h"
#include "meshes.h"

#include <talus/core/exceptions.h>

#include <fstream>

#include <unistd.h>

using namespace Talus;

namespace
{
  using namespace Test;

  /** The action must throw an InputError with all `parts` in its message. */
  void refused(const std::string &name, const std::vector<std::string> &parts, const std::function<void()> &action)
  {
    std::string message;
    try
    {
      action();
    }
    catch (const InputError &error)
    {
      message = error.message;
    }
    bool has_all = true;
    for (const auto &part : parts)
      has_all = has_all && message.find(part) != std::string::npos;
    check_true(name + ": " + message, has_all);
  }

  /** Two triangles or more on these points. */
  MeshInput<2> triangles(const std::vector<Coordinates<2>> &positions, const std::vector<MeshInput<2>::Corners> &cells)
  {
    MeshInput<2> input;
    input.name      = "test.msh";
    input.positions = positions;
    input.cells     = cells;
    return input;
  }

  template <int dim>
  MeshInput<dim> changed(const std::function<void(MeshInput<dim> &)> &change)
  {
    auto input = gmsh<dim>();
    change(input);
    return input;
  }

  /** The lines of a gmsh file, some of them replaced; a file of its own for each rank. */
  template <int dim>
  void read_changed(const std::string &from, const std::string &to)
  {
    std::ifstream     file(data(dim == 2 ? "plate.msh" : "block.msh"));
    const std::string all((std::istreambuf_iterator<char>(file)), {});
    const auto        place = all.find(from);
    check_true("  the file has " + from, place != std::string::npos);
    const std::string path = "mesh_test_" + std::to_string(getpid()) + ".msh";
    std::ofstream(path) << all.substr(0, place) << to << all.substr(place + from.size());
    try
    {
      read_msh<dim>(path);
    }
    catch (...)
    {
      std::remove(path.c_str());
      throw;
    }
    std::remove(path.c_str());
  }

  const std::vector<Coordinates<2>> unit_square = {{{0, 0}}, {{1, 0}}, {{0, 1}}, {{1, 1}}};

  void wrong_cells()
  {
    refused("inverted", {"triangle 1 around", "inverted", "triangle 0"}, [] {
      // Most are as they should be; vertex 3 has crossed the face that triangles 0 and 1 share.
      check_mesh(
        triangles({{{0, 0}}, {{1, 0}}, {{0, 1}}, {{.4, .4}}, {{1, -1}}}, {{{0, 1, 2}}, {{1, 3, 2}}, {{0, 4, 1}}}));
    });
    refused("inverted 3D", {"tetrahedron", "inverted: it overlaps its neighbour"}, [] {
      check_mesh(changed<3>([](auto &input) {
        auto &x = input.positions[input.cells[200][1]];
        x[0] += .5;
      }));
    });
    refused("flat", {"triangle 1 around", "is flat"}, [] {
      check_mesh(triangles({{{0, 0}}, {{1, 0}}, {{0, 1}}, {{.5, .5 + 1e-7}}}, {{{0, 1, 2}}, {{1, 3, 2}}}));
    });
    refused("a cell with a node twice", {"triangle 1 around", "is flat"}, [] {
      check_mesh(triangles(unit_square, {{{0, 1, 2}}, {{1, 3, 3}}}));
    });
    refused("flat 3D", {"tetrahedron", "is flat"}, [] {
      check_mesh(changed<3>([](auto &input) {
        const auto cell = input.cells[20];
        for (unsigned int d = 0; d < 3; ++d)
          input.positions[cell[3]][d] =
            (input.positions[cell[0]][d] + input.positions[cell[1]][d] + input.positions[cell[2]][d]) / 3;
      }));
    });
  }

  /** Nodes that hang, or are double, and faces of too many cells. */
  void wrong_joints()
  {
    refused("hanging", {"node 4 at (0.5, 0.5)", "hangs on a face of triangle 0"}, [] {
      auto positions = unit_square;
      positions.push_back({{.5, .5}});
      check_mesh(triangles(positions, {{{0, 1, 2}}, {{1, 3, 4}}, {{4, 3, 2}}}));
    });
    refused("hanging 3D", {"hangs on a face of tetrahedron 0"}, [] {
      MeshInput<3> input;
      input.positions = {{{0, 0, 0}}, {{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{.25, .25, 0}}, {{0, 0, -1}}};
      input.cells     = {{{0, 1, 2, 3}}, {{0, 1, 4, 5}}};
      check_mesh(input);
    });
    refused("two nodes at a place", {"node 1 at (1, 0)", "node 4 at (1, 0)", "not joined"}, [] {
      auto positions = unit_square;
      positions.push_back({{1, 0}});
      check_mesh(triangles(positions, {{{0, 1, 2}}, {{4, 3, 2}}}));
    });
    refused("three cells at a face", {"more than two cells", "triangle 0", "triangle 1", "triangle 2"}, [] {
      auto positions = unit_square;
      positions.push_back({{2, 2}});
      check_mesh(triangles(positions, {{{0, 1, 2}}, {{1, 3, 2}}, {{1, 4, 2}}}));
    });
    refused("unused node", {"node 5 at (2, 2)", "belongs to no triangle"}, [] {
      auto input = triangles(unit_square, {{{0, 1, 2}}, {{1, 3, 2}}});
      input.positions.push_back({{2, 2}});
      input.node_numbers = {1, 2, 3, 4, 5};
      check_mesh(input);
    });
    refused("empty", {"has no cells"}, [] { check_mesh(triangles({}, {})); });
  }

  void wrong_files()
  {
    refused("triangles in 3D", {"plate.msh", "no tetrahedra", "only cells of dimension 2"},
            [] { read_msh<3>(data("plate.msh")); });
    refused("tetrahedra in 2D", {"block.msh", "is a tetrahedron, but the run has 2 dimensions"}, [] {
      read_changed<3>("$MeshFormat", "$MeshFormat"); // as it is, it is read
      read_msh<2>(data("block.msh"));
    });
    refused("no file", {"nowhere.msh", "cannot read"}, [] { read_msh<2>("nowhere.msh"); });
    refused("other version", {"version 2.2, not 4.1"}, [] { read_changed<2>("4.1 0 8", "2.2 0 8"); });
    refused("binary", {"binary"}, [] { read_changed<2>("4.1 0 8", "4.1 1 8"); });
    refused("quadrilaterals", {"element 53", "type 3"}, [] { read_changed<2>("2 1 2 ", "2 1 3 "); });
    refused("cut off", {"ends too early"}, [] { read_changed<2>("\n286 ", ""); });
    refused("unknown boundary", {"no boundary 'top'", "'bottom' (11), 'outer wall' (12), 13"},
            [] { gmsh<2>().find_group("top"); });
  }
} // namespace

void wrong_meshes()
{
  check_mesh(gmsh<2>());
  check_mesh(gmsh<3>());
  check_mesh(triangles(unit_square, {{{0, 1, 2}}, {{1, 2, 3}}})); // the order of vertices does not matter

  wrong_cells();
  wrong_joints();
  wrong_files();
}
