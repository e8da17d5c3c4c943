// A disk about the origin by Delaunay's method; the centroids of its triangles are the particles of prm/umls_disks.prm:
// gmsh -2 -format msh41 disk.geo -o disk.msh [-setnumber h .0125]
DefineConstant[h = .025, radius = .2];
Point(1) = {0, 0, 0, h};
Point(2) = {radius, 0, 0, h};
Point(3) = {0, radius, 0, h};
Point(4) = {-radius, 0, 0, h};
Point(5) = {0, -radius, 0, h};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.Algorithm = 5;
Physical Surface("disk", 1) = {1};
