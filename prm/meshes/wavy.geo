// A channel 2 wide between the walls x = a (sin k1 y + sin k2 y) and the same + 2, for prm/wavy_channel.prm:
// gmsh -2 -format msh41 wavy.geo -o wavy.msh [-setnumber h .1]
// "walls" are its sides, "floor" and "top" its ends.
DefineConstant[h = .05];
a = .35; k1 = 1.2; k2 = .5;
bottom = -19; length = 20.5; n = 205;
For i In {0 : n}
  y = bottom + length * i / n;
  x = a * (Sin(k1 * y) + Sin(k2 * y));
  Point(1 + i) = {x, y, 0, h};
  Point(1001 + i) = {x + 2, y, 0, h};
EndFor
Spline(1) = {1 : 1 + n};
Spline(2) = {1001 : 1001 + n};
Line(3) = {1, 1001};
Line(4) = {1 + n, 1001 + n};
Curve Loop(1) = {3, 2, -4, -1};
Plane Surface(1) = {1};
Mesh.Algorithm = 5;
Physical Curve("walls", 11) = {1, 2};
Physical Curve("floor", 12) = {3};
Physical Curve("top", 13) = {4};
Physical Surface("channel", 1) = {1};
