# SPDX-License-Identifier: Apache-2.0
import json
import unittest

from support import AppTest, rmse_m, run


class GimbalFlights(AppTest):
    """A camera on a gimbal, from the simulator to what a user is told."""

    def replay(self, recording, *arguments):
        result = run("geoloc_replay", recording, "--out", self.folder / "objects.geojson", *arguments)
        self.assertEqual(result.status, 0, result.err)
        return result.err

    def fly(self, name, *options):
        result = run("geoloc_sim", "--record", self.folder / name, *options)
        self.assertEqual(result.status, 0, result.err)
        return self.folder / name

    def test_each_message_locates_the_objects(self):
        for message in "285", "265", "158":
            with self.subTest(message):
                recording = self.fly(message, "--gimbal", "sweep", "--gimbal-message", message)
                mount = json.loads((recording / "camera.json").read_text())["mount"]
                self.assertEqual((mount["kind"], mount["pitch_deg"]), ("gimbal", 0))
                said = self.replay(recording)
                self.assertLess(rmse_m(said), 0.1, said)
                self.assertIn("extra 0", said)
                self.assertNotIn("gimbal", said, "nothing to say of it")

    def test_a_wrong_yaw_flag_is_said_with_what_is_assumed(self):
        recording = self.fly("wrong", "--gimbal", "45", "--gimbal-told-yaw", "north", "--gimbal-wrong-flag")
        said = self.replay(recording)
        self.assertRegex(said, "says that its yaw counts from the vehicle's nose.* taken to count from north")
        self.assertIn("extra 0", said)
        for yaw, meaning in ("north", "north"), ("nose", "the vehicle's nose"):
            insisting = self.write("insist.json", {"state": {"gimbal_yaw": yaw}})
            self.assertIn(f"taken to count from {meaning}, as state.gimbal_yaw asks", self.replay(recording, "--config", insisting))

    def test_a_gimbal_that_tells_its_set_point_is_named(self):
        said = self.replay(self.fly("set-point", "--gimbal", "nadir", "--gimbal-setpoint-feedback"))
        self.assertIn("the gimbal's angles have no noise while the vehicle shakes", said)
        self.assertIn("extra 0", said)

    def test_a_gimbal_that_is_not_heard_is_the_reason_given(self):
        recording = self.fly("silent")
        camera = json.loads((recording / "camera.json").read_text())
        camera["mount"] = {"kind": "gimbal"}
        (recording / "camera.json").write_text(json.dumps(camera))
        said = self.replay(recording)
        self.assertIn("no frame was located", said)
        self.assertIn("no angles of the gimbal come (GIMBAL_DEVICE_ATTITUDE_STATUS", said)
        self.assertIn("camera.mount.kind", said)

    def test_options_that_cannot_go_together_are_refused(self):
        refused = [
            (("--gimbal", "nadir", "--mount-pitch-deg", "-45"), "--mount-pitch-deg"),
            (("--gimbal-wrong-flag",), "--gimbal"),
            (("--gimbal", "45", "--gimbal-message", "158", "--gimbal-wrong-flag"), "--gimbal-message 158"),
            (("--gimbal", "zenith"), "nadir"),
        ]
        for options, reason in refused:
            with self.subTest(options):
                result = run("geoloc_sim", "--record", self.folder / "refused", *options)
                self.assertNotEqual(result.status, 0)
                self.assertIn(reason, result.err)
                self.assertFalse((self.folder / "refused").exists())


if __name__ == "__main__":
    unittest.main()
