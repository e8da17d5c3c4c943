"""
The footing in ParaView, after `build/talus prm/footing.prm`:

    paraview --script=contrib/paraview/footing.py            # in its window
    pvpython contrib/paraview/footing.py footing.png         # or a picture

Particles as disks of their size, coloured by plastic strain, which shows the slip lines; the nodes' velocities as arrows. Change
DIRECTORY, FIELD and RADIUS for a run of your own.
"""
import os
import sys

from paraview.simple import (AnnotateTimeFilter, ColorBy, CreateRenderView, GetAnimationScene, GetColorTransferFunction, GetScalarBar,
                             Glyph, PVDReader, Render, SaveScreenshot, SetActiveView, Show)

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
DIRECTORY = os.path.join(ROOT, "output-footing")
FIELD = "equivalent_plastic_strain"
RADIUS = 0.018  # the particles' distance over sqrt(2): no gaps

view = CreateRenderView(ViewSize=[1200, 900], InteractionMode="2D", Background=[1, 1, 1], UseColorPaletteForBackground=0,
                        OrientationAxesVisibility=0)
SetActiveView(view)

particles = PVDReader(FileName=os.path.join(DIRECTORY, "particles.pvd"))
points = Show(particles, view)
points.SetRepresentationType("Point Gaussian")
points.ShaderPreset = "Plain circle"
points.GaussianRadius = RADIUS
ColorBy(points, ("POINTS", FIELD))

grid = PVDReader(FileName=os.path.join(DIRECTORY, "grid.pvd"))
arrows = Glyph(grid, GlyphType="2D Glyph", OrientationArray=["POINTS", "velocity"], ScaleArray=["POINTS", "velocity"], ScaleFactor=60,
               GlyphMode="Every Nth Point", Stride=17)
shown = Show(arrows, view)
shown.ColorArrayName = [None, ""]
shown.AmbientColor = shown.DiffuseColor = [0, 0, 0]

scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.GoToLast()
GetColorTransferFunction(FIELD).RescaleTransferFunction(0, 1e-3)
bar = GetScalarBar(GetColorTransferFunction(FIELD), view)
bar.Title, bar.ComponentTitle = FIELD.replace("_", " "), ""
bar.TitleColor = bar.LabelColor = [1, 1, 1]
points.SetScalarBarVisibility(view, True)
time = Show(AnnotateTimeFilter(particles, Format="t = {time:.3g}"), view)
time.Color = [0, 0, 0]
Render(view)  # places the camera
view.CameraFocalPoint, view.CameraPosition, view.CameraParallelScale = [1.4, 4, 0], [1.4, 4, 10], 1.2  # the slip lines
Render(view)
if len(sys.argv) > 1:
    SaveScreenshot(sys.argv[1], view)
