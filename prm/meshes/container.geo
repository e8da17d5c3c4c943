// A ball of radius .5 + h around the origin filled with tetrahedra, for prm/container.prm: one layer of cells beyond the wall:
// gmsh -3 -format msh41 container.geo -o container.msh [-setnumber h .03]
SetFactory("OpenCASCADE");
DefineConstant[h = .05];
Sphere(1) = {0, 0, 0, .5 + h};
MeshSize{ PointsOf{ Volume{1}; } } = h;
Mesh.MeshSizeMin = h;
Mesh.MeshSizeMax = h;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Physical Surface("wall", 11) = {1};
Physical Volume("container", 1) = {1};
