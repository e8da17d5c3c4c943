// The square (0, 0) - (2, 2) by Delaunay's method, for prm/umls_apic.prm and prm/umls_disks.prm:
// gmsh -2 -format msh41 square.geo -o square.msh [-setnumber h .05]
// "outer" is its boundary.
DefineConstant[h = .1, size = 2, corner = 0];
Point(1) = {corner, corner, 0, h};
Point(2) = {corner + size, corner, 0, h};
Point(3) = {corner + size, corner + size, 0, h};
Point(4) = {corner, corner + size, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.Algorithm = 5;
Physical Curve("outer", 11) = {1, 2, 3, 4};
Physical Surface("square", 1) = {1};
