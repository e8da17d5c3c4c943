// A box of tetrahedra by Delaunay's method, for prm/clay_slope_3d.prm:
// gmsh -3 -format msh41 slope.geo -o slope.msh [-setnumber h .2] [-setnumber width 5]
// "floor" (y = 0), "back" (x = 0), "front" (the other end), "left" (z = 0), "right" (z = width), "top".
DefineConstant[h = .5, length = 30, height = 6, width = 1];
Point(1) = {0, 0, 0, h};
Point(2) = {length, 0, 0, h};
Point(3) = {length, height, 0, h};
Point(4) = {0, height, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
face[] = Extrude {0, 0, width} { Surface{1}; };
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Physical Surface("floor", 11) = {face[2]};
Physical Surface("front", 12) = {face[3]};
Physical Surface("top", 13) = {face[4]};
Physical Surface("back", 14) = {face[5]};
Physical Surface("left", 15) = {1};
Physical Surface("right", 16) = {face[0]};
Physical Volume("box", 1) = {face[1]};
