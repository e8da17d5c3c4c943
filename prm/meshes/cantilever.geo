// The box (0, -3) - (5, 2) by Delaunay's method, turned by `angle` degrees about the origin, for prm/umls_cantilever.prm:
// gmsh -2 -format msh41 cantilever.geo -o cantilever.msh [-setnumber h .05] [-setnumber angle 30]
// "wall" is the side that is at x = 0 before it is turned, "outer" the others.
DefineConstant[h = .1, angle = 0];
c = Cos(angle * Pi / 180);
s = Sin(angle * Pi / 180);
Point(1) = {3 * s, -3 * c, 0, h};
Point(2) = {5 * c + 3 * s, 5 * s - 3 * c, 0, h};
Point(3) = {5 * c - 2 * s, 5 * s + 2 * c, 0, h};
Point(4) = {-2 * s, 2 * c, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Mesh.Algorithm = 5;
Physical Curve("wall", 10) = {4};
Physical Curve("outer", 11) = {1, 2, 3};
Physical Surface("box", 1) = {1};
