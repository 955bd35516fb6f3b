# touch.py FILE: touch a cloud with the mouse. F: the hand follows the pointer, Q: the end.
import sys
import pointhaptics as ph
import vtk
reader = ph.vtkPointCloudReader()
reader.SetFileName(sys.argv[1])  # in metres about the origin, such as pointhaptics generate idol -n 200000 -o idol.ply
means = ph.vtkVoxelMeanResampler()
means.SetInputConnection(reader.GetOutputPort())
window = vtk.vtkRenderWindow()
window.AddRenderer(vtk.vtkRenderer())
style = ph.vtkInteractorStyleHaptic()
style.SetResampler(means)
window.MakeRenderWindowInteractor().SetInteractorStyle(style)
touch = ph.vtkHapticTouch()
touch.Run(style)  # a simulated hand; SetDeviceName("falcon") takes a Falcon
