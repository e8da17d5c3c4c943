// A unit cube with cells that shrink towards a corner: the block of tests/mesh. Written by
// gmsh -3 -format msh41 block.geo
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
MeshSize{:} = .4;
MeshSize{1} = .2;
Physical Surface("left", 5) = {1};
Physical Surface("others", 6) = {2, 3, 4, 5, 6};
Physical Volume("block", 1) = {1};
