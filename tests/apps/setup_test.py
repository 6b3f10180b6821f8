# SPDX-License-Identifier: Apache-2.0
import socket
import unittest

from support import PROGRAMS, AppTest, World, free_port, run


class UnusableInput(AppTest):
    """Wrong files and arguments end a program with status 2 and a reason before anything starts."""

    def start_app(self, *arguments):
        return run("geoloc_app", *World().inputs(), *arguments)

    def test_a_port_in_use_is_named(self):
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as holder:
            holder.bind(("127.0.0.1", 0))
            port = holder.getsockname()[1]
            result = run("geoloc_app", "--udp", f"127.0.0.1:{port}", "--rtsp", f"rtsp://127.0.0.1:{free_port()}/cam")
        self.assert_refused(result, port, "in use", "--udp")

    def test_all_faults_of_a_configuration_are_listed(self):
        config = self.write("config.json", {"paper": {"gate": -1, "gates": 3}, "video": {"retry_max_s": "soon"},
                                            "camera": str(self.folder / "camera.yaml"), "colour": "blue"})
        self.assert_refused(self.start_app("--config", config), config, "paper.gate ", "paper.gates", "video.retry_max_s",
                            "colour", self.folder / "camera.yaml")

    def test_a_camera_that_cannot_be_is_named(self):
        camera = {"width": 1280, "height": 720, "fx": 900, "fy": 900, "cx": 640, "cy": 360}
        for key, value in ("fx", 1e-12), ("fy", 1e300), ("cx", 1e300), ("distortion", [1e300]):
            with self.subTest(key):
                config = self.write("config.json", {"camera": {**camera, key: value}})
                self.assert_refused(self.start_app("--config", config), f"camera.{key}")
        config = self.write("config.json", {"camera": camera, "edge_margin_px": 360})
        self.assert_refused(self.start_app("--config", config), "edge_margin_px must be less than half of the image")

    def test_faults_of_several_files_are_listed_together(self):
        result = self.start_app("--config", self.write("config.json", {"colour": "blue"}),
                                "--model", self.write("model.onnx", "no network"),
                                "--truth", self.folder / "truth.geojson")
        self.assert_refused(result, "colour", self.folder / "model.onnx", self.folder / "truth.geojson")

    def test_a_model_that_is_none(self):
        for name, content in {"missing": None, "empty": "", "text": "no network\n" * 1000}.items():
            with self.subTest(name):
                model = self.folder / f"{name}.onnx"
                if content is not None:
                    model.write_text(content)
                self.assert_refused(self.start_app("--model", model), model)

    def test_files_that_are_not_what_they_should_be(self):
        self.assert_refused(self.start_app("--config", self.write("config.json", "{")), "config.json", "JSON")
        self.assert_refused(self.start_app("--config", self.folder), self.folder)
        self.assert_refused(self.start_app("--truth", self.write("truth.geojson", "[]")), "truth.geojson")

    def test_recording_into_a_folder_in_use(self):
        kept = self.write("kept.txt", "precious")
        self.assert_refused(self.start_app("--record", self.folder), self.folder)
        self.assertEqual([kept], list(self.folder.iterdir()))

    def test_wrong_arguments(self):
        udp = ("--udp", f"127.0.0.1:{free_port()}")
        self.assert_refused(run("geoloc_app", *udp), "--rtsp", "--video")
        self.assert_refused(run("geoloc_app", *udp, "--rtsp", "http://127.0.0.1/cam"), "http://127.0.0.1/cam")
        self.assert_refused(run("geoloc_app", *udp, "--video", self.folder / "none.mp4"), self.folder / "none.mp4")
        self.assert_refused(run("geoloc_app", "--udp", "127.0.0.1:70000", "--rtsp", "rtsp://127.0.0.1/cam"), "70000")
        self.assert_refused(self.start_app("--method", "magic"), "method", "paper")
        self.assert_refused(self.start_app("--no-such-option"), "--no-such-option")

    def test_a_simulator_that_does_not_know_the_flight_lists_those_it_knows(self):
        self.assert_refused(run("geoloc_sim", "--flight", "none", "--record", self.folder / "recording"),
                            "stock_path1", "gnss_path6")
        self.assertFalse((self.folder / "recording").exists())

    def test_help_is_no_fault(self):
        for program in PROGRAMS:
            with self.subTest(program):
                result = run(program, "--help")
                self.assertEqual((result.status, result.err), (0, ""))


if __name__ == "__main__":
    unittest.main()
