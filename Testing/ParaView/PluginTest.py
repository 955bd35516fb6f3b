"""The ParaView plugin in pvpython: results are the program's bit for bit, defaults fit, bad input is an error."""

import os
import re
import unittest

import numpy as np
from paraview import servermanager, simple, smstate, smtrace
from vtkmodules.util.numpy_support import vtk_to_numpy

from support import ErrorMessages, TestCase, arrays_of, load_plugin, read_vtp, run_program, shared_data

load_plugin()


OWN_PROXY = """
<ServerManagerConfiguration>
  <ProxyGroup name="filters">
    <SourceProxy class="vtkPVVoxelMeanResampler" name="OwnResampler">
      <InputProperty command="SetInputConnection" name="Input"/>
      <IntVectorProperty command="SetDimensions" default_values="1 1 1" name="Dimensions" number_of_elements="3"/>
      <StringVectorProperty command="AddCategoricalArray" name="Add" number_of_elements="1"/>
      <StringVectorProperty command="RemoveCategoricalArray" name="Remove" number_of_elements="1"/>
      <DoubleVectorProperty command="SetWorkspaceBounds" default_values="0 1 0 1 0 1" name="Bounds" number_of_elements="6"/>
      <DoubleVectorProperty command="SetWorkspacePosition" default_values="0 0 0" name="Position" number_of_elements="3"/>
      <DoubleVectorProperty command="GetWorkspaceBounds" information_only="1" name="FoundBounds">
        <SimpleDoubleInformationHelper/>
      </DoubleVectorProperty>
    </SourceProxy>
  </ProxyGroup>
</ServerManagerConfiguration>
"""


def blocks_of(data):
    """The clouds of a dataset: itself, or those in a composite."""
    if data.IsA("vtkPolyData"):
        return [data]
    each = data.NewIterator()
    each.UnRegister(None)
    blocks = []
    each.InitTraversal()
    while not each.IsDoneWithTraversal():
        blocks.append(each.GetCurrentDataObject())
        each.GoToNextItem()
    return blocks


class Resampling(TestCase):
    def cloud(self):
        run_program("generate", "idol", "-n", 20000, "-o", self.path("in.ply"))
        return simple.PointHapticsReader(FileNames=[self.path("in.ply")])

    def test_by_voxel_size(self):
        self.resampled(
            simple.VoxelMeanResampler(Input=self.cloud(), VoxelSize=0.002, ComputeCovariance=1),
            self.path("in.ply"), "--voxel", 0.002, "--covariance",
        )  # fmt: skip

    def test_by_dimensions_as_the_program_does_by_default(self):
        means = simple.VoxelMeanResampler(Input=self.cloud(), LatticeMode="Dimensions")
        self.resampled(means, self.path("in.ply"))

    def test_each_change_is_what_the_panel_shows(self):
        means = simple.VoxelMeanResampler(Input=self.cloud(), VoxelSize=0.004)
        means.Dimensions = [40, 50, 60]  # sent, but the voxel size rules
        self.resampled(means, self.path("in.ply"), "--voxel", 0.004)
        means.LatticeMode = "Dimensions"
        self.resampled(means, self.path("in.ply"), "--dims", "40,50,60")
        means.VoxelSize = 0.001
        self.resampled(means, self.path("in.ply"), "--dims", "40,50,60")
        means.WorkspacePosition, means.WorkspaceSize = [-0.03125] * 3, [0.0625, 0.09375, 0.125]
        self.resampled(means, self.path("in.ply"), "--dims", "40,50,60")
        means.AutomaticWorkspace = 0
        self.resampled(means, self.path("in.ply"), "--dims", "40,50,60", "--workspace=-0.03125,0.03125,-0.03125,0.0625,-0.03125,0.09375")
        means.UpdatePropertyInformation()
        self.assertGreater(means.GetPropertyValue("NumberOfClippedPoints"), 0)
        means.AutomaticWorkspace = 1
        means.LatticeMode = "Voxel Size"
        self.resampled(means, self.path("in.ply"), "--voxel", 0.001)

    def test_a_given_value_is_no_default(self):
        """ParaView takes a value for not given that is the default of the XML."""
        cloud = self.cloud()
        cloud.UpdatePipeline()
        paper = {"WorkspacePosition": [-0.05] * 3, "WorkspaceSize": [0.1] * 3}
        means = simple.VoxelMeanResampler(Input=cloud, VoxelSize=0.001, **paper)
        self.assertEqual((means.VoxelSize, list(means.WorkspacePosition), list(means.WorkspaceSize)), (0.001, *paper.values()))
        self.assertEqual(simple.KernelBandwidth(Input=cloud, Radius=0.001).Radius, 0.001)

    def test_representatives(self):
        means = simple.VoxelMeanResampler(Input=self.cloud(), VoxelSize=0.004, MinimumPointsPerVoxel=2)
        for shown, option in (("Nearest to the Mean", "nearest-to-mean"), ("Median", "median")):
            means.Representative = shown
            self.resampled(means, self.path("in.ply"), "--voxel", 0.004, "--representative", option,
                           "--minimum-points", 2)  # fmt: skip

    def test_defaults_fit_the_input(self):
        cloud = self.cloud()
        for factor in (1, 1000):
            scaled = simple.Transform(Input=cloud)
            scaled.Transform.Scale = [factor] * 3
            scaled.UpdatePipeline()
            means = simple.VoxelMeanResampler(Input=scaled)
            bounds = scaled.GetDataInformation().GetBounds()
            longest = max(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
            self.assertAlmostEqual(means.VoxelSize / (longest / 100), 1, places=6)
            self.assertEqual(list(means.WorkspacePosition), list(bounds[::2]))
            for size, low, high in zip(means.WorkspaceSize, bounds[::2], bounds[1::2]):
                self.assertAlmostEqual(size, high - low, places=9)
            found = servermanager.Fetch(means).GetNumberOfPoints()
            self.assertTrue(1000 < found < 20000, found)


class Bandwidths(TestCase):
    def test_of_a_cloud_and_of_means(self):
        run_program("generate", "idol", "-n", 20000, "-o", self.path("in.ply"))
        cloud = simple.PointHapticsReader(FileNames=[self.path("in.ply")])
        self.bandwidths(simple.KernelBandwidth(Input=cloud, ComputeDensity=1), self.path("in.ply"), "--density",
                        "gaussian")  # fmt: skip
        means = simple.VoxelMeanResampler(Input=cloud, VoxelSize=0.002)
        run_program("resample", self.path("in.ply"), "-o", self.path("means.vtp"), "--voxel", 0.002)
        radii = simple.KernelBandwidth(
            Input=means, Rule="Silverman, Robust", RadiusScale=3, MinimumRadius=0.0001, MaximumRadius=0.002,
            NumberOfNeighbors=12,
        )  # fmt: skip
        self.bandwidths(radii, self.path("means.vtp"), "--rule", "silverman-robust", "--beta", 3, "--r1", 0.0001,
                        "--r2", 0.002, "--neighbors", 12, "--density", "none")  # fmt: skip


class Touch(TestCase):
    def test_a_path_is_felt_as_by_the_program(self):
        run_program("generate", "sphere", "-n", 20000, "-o", self.path("in.ply"))
        with open(self.path("path.csv"), "w") as path:
            path.write("t,x,y,z\n0,-0.005,0,0.03\n0.2,-0.005,0,0.022\n0.4,0.005,0,0.022\n")
        feel = simple.HapticFeel(
            Input=simple.PointHapticsReader(FileNames=[self.path("in.ply")]),
            Path=simple.CSVReader(FileName=[self.path("path.csv")]), Stiffness=600, StaticFriction=0.4,
            DynamicFriction=0.3,
        )  # fmt: skip
        for voxel in (0, 0.002):
            with self.subTest(voxel):
                feel.VoxelSize = voxel
                options = ("--voxel", voxel) if voxel else ()
                run_program("feel", self.path("in.ply"), "--path", self.path("path.csv"), "-o", self.path("felt.csv"),
                            "--stiffness", 600, "--mu-s", 0.4, "--mu-d", 0.3, "--force", *options)  # fmt: skip
                expected = np.genfromtxt(self.path("felt.csv"), delimiter=",", names=True)
                found = servermanager.Fetch(feel)
                self.assertEqual(found.GetNumberOfRows(), len(expected))
                self.assertGreater(expected["contact"].sum(), 100)
                for name in expected.dtype.names:
                    if name not in ("update_us", "status"):
                        column = vtk_to_numpy(found.GetRowData().GetArray(name))
                        self.assertTrue((column == expected[name]).all(), name)


class RealClouds(TestCase):
    def test_lidar_with_labels_and_colors(self):
        path = shared_data("formats/autzen_trim.laz")
        means = simple.VoxelMeanResampler(Input=simple.PointHapticsReader(FileNames=[path]), VoxelSize=20)
        self.resampled(means, path, "--voxel", 20)

    def test_scan(self):
        path = shared_data("office1.pcd")
        means = simple.VoxelMeanResampler(Input=simple.PointHapticsReader(FileNames=[path]), LatticeMode="Dimensions")
        self.resampled(means, path)


class Files(TestCase):
    def test_the_writer_writes_what_the_program_does(self):
        cloud = read_sphere(self)
        for extension in ("ply", "pcd", "las", "laz", "csv", "vtp"):
            with self.subTest(extension):
                path, other = self.path(f"out.{extension}"), self.path(f"program.{extension}")
                servermanager.writers.PointHapticsWriter(Input=cloud, FileName=path).UpdatePipeline()
                run_program("convert", self.path("in.ply"), other)
                found, expected = (simple.PointHapticsReader(FileNames=[name]) for name in (path, other))
                self.assert_same_bits(servermanager.Fetch(found), servermanager.Fetch(expected))

    def test_the_reader_gives_what_the_program_reads(self):
        cloud = read_sphere(self)
        run_program("convert", self.path("in.ply"), self.path("program.vtp"))
        self.assert_same_bits(servermanager.Fetch(cloud), read_vtp(self.path("program.vtp")))

    def test_saving_data_finds_the_writer(self):
        for extension, name in (("laz", "LAZ"), ("xyz", "text")):
            simple.SaveData(self.path(f"out.{extension}"), proxy=read_sphere(self))
            self.assertIn(name, run_program("info", self.path(f"out.{extension}")))

    def test_the_formats_of_the_program_are_offered(self):
        """The reader for all of them, and one writer for each that is written."""
        rows = [line.split("|") for line in run_program("manual", "formats").splitlines()[2:]]
        manager = servermanager.vtkSMProxyManager.GetProxyManager()
        readers = manager.GetReaderFactory().GetSupportedFileTypes(servermanager.ActiveConnection.Session)
        ours = [line for line in readers.split(";;") if "PointHaptics" in line]
        self.assertEqual(len(ours), 1, readers)
        self.assertEqual(set(re.findall(r"\*\.(\w+)", ours[0])), {"gz", *re.findall(r"\w+", " ".join(row[2] for row in rows))})
        writers = manager.GetWriterFactory().GetSupportedFileTypes(read_sphere(self).SMProxy, 0)
        offered = re.findall(r"\*\.(\w+)", writers.split(";;", 1)[1] if writers.startswith("Supported") else writers)
        for extension in re.findall(r"\w+", " ".join(row[3] for row in rows)):
            self.assertEqual(offered.count(extension), 1, (extension, writers))

    def test_several_files_are_a_time_series(self):
        for points in (100, 200):
            run_program("generate", "sphere", "-n", points, "-o", self.path(f"{points}.ply"))
        cloud = simple.PointHapticsReader(FileNames=[self.path("100.ply"), self.path("200.ply")])
        cloud.UpdatePipelineInformation()
        for time, points in ((0, 100), (1, 200)):
            cloud.UpdatePipeline(time)
            self.assertEqual(cloud.GetDataInformation().GetNumberOfPoints(), points)


class InPipelines(TestCase):
    def labels(self):
        with open(self.path("labels.csv"), "w") as file:
            file.write("x,y,z,Classification,ReturnNumber\n")
            file.writelines(f"{i % 10},{i // 10 % 10},{i % 3 / 10},{i % 4 * 10},{i % 5 * 10}\n" for i in range(1000))
        cloud = simple.PointHapticsReader(registrationName="labels.csv", FileNames=[self.path("labels.csv")])
        cloud.UpdatePipeline()
        return cloud

    def test_grids_of_other_filters_are_clouds_too(self):
        grid = simple.Threshold(Input=self.labels(), Scalars=["POINTS", "Classification"],
                                LowerThreshold=0, UpperThreshold=20, ThresholdMethod="Between")  # fmt: skip
        radii = simple.KernelBandwidth(Input=grid)
        self.assertEqual(servermanager.Fetch(radii).GetNumberOfPoints(), 750)
        simple.SaveData(self.path("grid.pcd"), proxy=grid)
        self.assertIn("750", run_program("info", self.path("grid.pcd")))

    def test_every_kind_of_composite_has_one_lattice(self):
        run_program("generate", "sphere", "-n", 3000, "-o", self.path("near.ply"))
        near = simple.PointHapticsReader(registrationName="near", FileNames=[self.path("near.ply")])
        far = simple.Transform(registrationName="far", Input=near)
        far.Transform.Translate = [0.3, 0, 0]
        lattice = ("LatticeOrigin", "LatticeSpacing", "LatticeDimensions")

        def lattices(source):
            means = simple.VoxelMeanResampler(Input=source, LatticeMode="Dimensions")
            means.UpdatePipeline()
            # Fetch() of ParaView 5.11 gives nothing of partitions.
            blocks = blocks_of(means.SMProxy.GetClientSideObject().GetOutputDataObject(0))
            fields = [[vtk_to_numpy(block.GetFieldData().GetArray(name)).tolist() for name in lattice] for block in blocks]
            return fields, sum(block.GetNumberOfPoints() for block in blocks)

        expected, count = lattices(simple.MergeBlocks(Input=simple.GroupDatasets(Input=[near, far])))
        blocks, partitions, collection = "vtkMultiBlockDataSet", "vtkPartitionedDataSet", "vtkPartitionedDataSetCollection"
        for kind, outer in ((blocks, blocks), (partitions, collection), (collection, None)):
            group = simple.GroupDatasets(Input=[near, far], OutputType=kind)
            tree = simple.GroupDatasets(Input=[group, group], OutputType=outer) if outer else group
            for source in (group, tree):
                with self.subTest(kind, tree=source is not group):
                    found, points = lattices(source)
                    self.assertEqual(len(found), 2 if source is group else 4)
                    self.assertTrue(all(fields == expected[0] for fields in found), found)
                    self.assertEqual(points, count * len(found) // 2)  # no voxel has points of both

    def test_progress_has_the_names_of_the_menu(self):
        cloud = self.labels()
        filters = (simple.VoxelMeanResampler(Input=cloud, VoxelSize=3), simple.KernelBandwidth(Input=cloud), simple.HapticFeel())
        for proxy, name in zip((cloud, *filters), ("PointHaptics Reader", "Voxel Mean Resampler", "Kernel Bandwidth", "Haptic Feel")):
            self.assertEqual(proxy.SMProxy.GetClientSideObject().GetProgressText(), name)

    def test_the_arrays_with_labels_are_those_that_are_ticked(self):
        means = simple.VoxelMeanResampler(Input=self.labels(), VoxelSize=3)
        self.assertEqual(list(means.CategoricalArrays), ["Classification"])
        for chosen in ([], ["ReturnNumber"], ["Classification", "ReturnNumber"]):
            means.CategoricalArrays = chosen
            found = arrays_of(servermanager.Fetch(means))
            for name in ("Classification", "ReturnNumber"):
                # A mean is none of the labels, which are multiples of ten.
                self.assertEqual((found[name] % 10 == 0).all(), name in chosen, (name, chosen))

    def test_a_tick_means_one_array(self):
        cloud = self.labels()
        for name in ("Label", "scalar_Label"):
            cloud = simple.Calculator(Input=cloud, Function="Classification", ResultArrayName=name)
        cloud.UpdatePipeline()
        means = simple.VoxelMeanResampler(Input=cloud, VoxelSize=3)
        self.assertEqual(sorted(means.CategoricalArrays), ["Classification", "Label", "scalar_Label"])
        for ticked in ("Label", "scalar_Label"):
            means.CategoricalArrays = [ticked]
            found = arrays_of(servermanager.Fetch(means))
            for name in ("Label", "scalar_Label"):
                self.assertEqual((found[name] % 10 == 0).all(), name == ticked, (name, ticked))

    def test_each_value_has_one_owner(self):
        """The functions of the superclass set what the panel's set: here they are properties of a proxy."""
        with open(self.path("own.xml"), "w") as file:
            file.write(OWN_PROXY)
        simple.LoadPlugin(self.path("own.xml"), ns=vars(simple))
        means = simple.OwnResampler(Input=self.labels(), Dimensions=[3, 3, 3], Add="ReturnNumber", Bounds=[0, 6, 0, 6, 0, 6])
        found = arrays_of(servermanager.Fetch(means))
        for name in ("Classification", "ReturnNumber"):
            self.assertTrue((found[name] % 10 == 0).all(), name)
        means.UpdatePropertyInformation()
        self.assertEqual(list(means.GetPropertyValue("FoundBounds")), [0, 6, 0, 6, 0, 6])
        means.Position, means.Remove = [1, 1, 0], "Classification"
        found = arrays_of(servermanager.Fetch(means))
        self.assertFalse((found["Classification"] % 10 == 0).all())
        self.assertTrue((found["ReturnNumber"] % 10 == 0).all())
        means.UpdatePropertyInformation()
        self.assertEqual(list(means.GetPropertyValue("FoundBounds")), [1, 7, 1, 7, 0, 6])

    def test_a_saved_state_and_a_trace_give_the_same_points(self):
        new_session()
        cloud = self.labels()
        smtrace.start_trace()
        means = simple.VoxelMeanResampler(
            registrationName="means", Input=cloud, VoxelSize=3, CategoricalArrays=["ReturnNumber"], AutomaticWorkspace=0,
            WorkspacePosition=[0, 0, 0], WorkspaceSize=[6, 6, 6],
        )  # fmt: skip
        trace = smtrace.stop_trace()
        expected = arrays_of(servermanager.Fetch(means))
        simple.SaveState(self.path("state.pvsm"))
        script = smstate.get_state()
        self.same(expected, lambda: simple.LoadState(self.path("state.pvsm")))
        self.same(expected, lambda: exec(script, {}))
        self.same(expected, lambda: (self.labels(), exec(trace, {})))

    def same(self, expected, load):
        new_session()
        load()
        found = arrays_of(servermanager.Fetch(simple.FindSource("means")))
        self.assertEqual(sorted(found), sorted(expected))
        for name in expected:
            self.assertTrue((found[name] == expected[name]).all(), name)

    def test_what_was_left_out_is_in_the_information(self):
        means = simple.VoxelMeanResampler(Input=self.labels(), VoxelSize=1, AutomaticWorkspace=0,
                                          WorkspacePosition=[0, 0, 0], WorkspaceSize=[5, 20, 20])  # fmt: skip
        field = servermanager.Fetch(means).GetFieldData()
        self.assertEqual(field.GetArray("ClippedPoints").GetValue(0), 500)
        self.assertEqual(field.GetArray("InvalidPoints").GetValue(0), 0)


class BadInput(TestCase):
    """Each is an error in ParaView's message window that names the cure, and an empty output: no crash."""

    def assert_error(self, proxy, *words):
        with ErrorMessages() as messages:
            proxy.UpdatePipeline()
        text = " ".join(messages.found)
        for word in words:
            self.assertIn(word, text)
        self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), 0)

    def test_files(self):
        with open(self.path("bad.las"), "wb") as file:
            file.write(b"LASF" + b"\xff" * 300)
        self.assert_error(simple.PointHapticsReader(FileNames=[self.path("bad.las")]), "bad.las", "LAS")

    def test_lattice(self):
        cloud = read_sphere(self)
        for size in (0, -1, float("nan")):
            with self.subTest(size):
                self.assert_error(simple.VoxelMeanResampler(Input=cloud, VoxelSize=size), "VoxelSize", "above 0")
        self.assert_error(simple.VoxelMeanResampler(Input=cloud, VoxelSize=1e-12), "voxel")
        self.assert_error(simple.VoxelMeanResampler(Input=cloud, LatticeMode="Dimensions", Dimensions=[0, 1, 1]), "0")
        self.assert_error(
            simple.VoxelMeanResampler(Input=cloud, AutomaticWorkspace=0, WorkspaceSize=[0, 1, 1]), "workspace"
        )
        flat = simple.VoxelMeanResampler(Input=cloud, Transform="Transform")
        flat.Transform.Scale = [1, 1, 0]
        self.assert_error(flat, "singular")

    def test_bandwidths(self):
        cloud = read_sphere(self)
        for options in ({"NumberOfNeighbors": 0}, {"RadiusScale": 0}, {"MinimumRadius": 2, "MaximumRadius": 1}):
            with self.subTest(options):
                self.assert_error(simple.KernelBandwidth(Input=cloud, **options), *options)

    def test_points_that_are_not_finite(self):
        with open(self.path("some.csv"), "w") as file:
            file.write("x,y,z,t\n" + "".join(f"{i},{i % 7},{i % 3},{i}.5\nnan,1,inf,0.5\n" for i in range(500)))
        some = simple.PointHapticsReader(FileNames=[self.path("some.csv")])
        means = simple.VoxelMeanResampler(Input=some, LatticeMode="Dimensions", Dimensions=[40, 40, 40])
        self.resampled(means, self.path("some.csv"), "--dims", 40)
        means.UpdatePropertyInformation()
        self.assertEqual(means.GetPropertyValue("NumberOfInvalidPoints"), 500)
        self.bandwidths(simple.KernelBandwidth(Input=some), self.path("some.csv"), "--density", "none")
        with open(self.path("all.csv"), "w") as file:
            file.write("x,y,z\n" + "nan,nan,nan\n" * 100)
        none = simple.PointHapticsReader(FileNames=[self.path("all.csv")])
        for mode in ("Voxel Size", "Dimensions"):
            with ErrorMessages():
                means = simple.VoxelMeanResampler(Input=none, LatticeMode=mode)
                means.UpdatePipeline()
            self.assertEqual(means.GetDataInformation().GetNumberOfPoints(), 0)
        radii = simple.KernelBandwidth(Input=none)
        radii.UpdatePipeline()
        self.assertEqual(radii.GetDataInformation().GetNumberOfPoints(), 100)

    def test_huge_lattices(self):
        cloud = read_sphere(self)
        most = 2**21
        means = simple.VoxelMeanResampler(Input=cloud, LatticeMode="Dimensions", Dimensions=[most] * 3)
        self.resampled(means, self.path("in.ply"), "--dims", most)
        self.assert_error(
            simple.VoxelMeanResampler(Input=cloud, LatticeMode="Dimensions", Dimensions=[most + 1] * 3), str(most + 1)
        )
        self.assert_error(
            simple.VoxelMeanResampler(Input=cloud, VoxelSize=1e-9, AutomaticWorkspace=0,
                                      WorkspacePosition=[-1e30] * 3, WorkspaceSize=[2e30] * 3), "voxel"
        )  # fmt: skip

    def test_a_file_that_cannot_be_written(self):
        cloud = read_sphere(self)
        with ErrorMessages() as messages:
            writer = simple.CreateWriter(self.path("no/such/folder/out.pcd"), cloud)
            writer.UpdatePipeline()
        self.assertIn("out.pcd", " ".join(messages.found))

    def test_a_cloud_without_points_is_not_written(self):
        for empty in (
            simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script=""),
            simple.VoxelMeanResampler(Input=read_sphere(self), AutomaticWorkspace=0, VoxelSize=0.1,
                                      WorkspacePosition=[9, 9, 9], WorkspaceSize=[1, 1, 1]),
        ):  # fmt: skip
            with ErrorMessages("WarningEvent"), ErrorMessages() as messages:
                simple.SaveData(self.path("out.pcd"), proxy=empty)
            self.assertEqual(len(messages.found), 1, messages.found)
            self.assertIn("the cloud holds no points", messages.found[0])
            self.assertFalse(os.path.exists(self.path("out.pcd")))

    def test_each_is_one_message(self):
        """However often ParaView updates for one action, and whatever comes after."""
        with open(self.path("turned.csv"), "w") as file:
            file.write("t,x,y,z\n1,0,0,0\n0,0,0,0\n")
        path = simple.CSVReader(FileName=[self.path("turned.csv")])
        cloud, absent = read_sphere(self), simple.PointHapticsReader(FileNames=[self.path("absent.las")])
        path.UpdatePipeline()
        resampler, bandwidth, feel = simple.VoxelMeanResampler, simple.KernelBandwidth, simple.HapticFeel
        for make in (
            lambda: absent,
            lambda: resampler(Input=cloud, VoxelSize=0),
            lambda: resampler(Input=simple.GroupDatasets(Input=[cloud, path]), VoxelSize=1e-12),
            lambda: resampler(Input=cloud, AutomaticWorkspace=0, WorkspacePosition=[9, 9, 9], WorkspaceSize=[1, 1, 1]),
            lambda: bandwidth(Input=cloud, NumberOfNeighbors=0),
            lambda: feel(Input=cloud, Path=path),
            lambda: feel(Input=simple.PointHapticsReader(FileNames=[self.path("missing.las")]), Path=path),
        ):
            proxy = make()
            with ErrorMessages() as messages, ErrorMessages("WarningEvent") as warnings:
                for _ in range(3):
                    proxy.UpdatePipeline()
                    servermanager.Fetch(proxy)
                if proxy.SMProxy.GetXMLName() != "HapticFeel":
                    bandwidth(Input=proxy).UpdatePipeline()
            self.assertEqual(len(messages.found + warnings.found), 1, messages.found + warnings.found)

    def test_nothing_at_all(self):
        empty = simple.ProgrammableSource(OutputDataSetType="vtkPolyData", Script="")
        for proxy in (simple.VoxelMeanResampler(Input=empty), simple.KernelBandwidth(Input=empty)):
            proxy.UpdatePipeline()
            self.assertEqual(proxy.GetDataInformation().GetNumberOfPoints(), 0)


def new_session():
    simple.ResetSession()
    load_plugin()


def read_sphere(test):
    run_program("generate", "sphere", "-n", 5000, "-o", test.path("in.ply"))
    return simple.PointHapticsReader(FileNames=[test.path("in.ply")])


if __name__ == "__main__":
    unittest.main()
