# SPDX-License-Identifier: Apache-2.0
"""A fleet on the page, in a browser."""
import json
import unittest

from browser import SCREENS, BrowserTest, url_of
from support import Live, run


class FleetPage(BrowserTest):
    def summaries(self):
        """Four flights, of which the last is 6 m off."""
        files = []
        for flight in ("gnss_path1", "gnss_path2", "gnss_path3", "gnss_path4"):
            recording, file = self.folder / flight, self.folder / f"{flight}.json"
            run("geoloc_sim", "--record", recording, "--flight", flight, "--scenario", 2)
            run("geoloc_replay", recording, "--flight-id", flight, "--summary", file, "--out", self.objects_file)
            files.append(file)
        moved = json.loads(files[-1].read_text())
        for thing in moved["objects"]:
            thing["position_in_enu_m"][0] += 6.0
        files[-1].write_text(json.dumps(moved))
        return files

    def test_names_the_flight_that_is_left_out_on_every_screen(self):
        with Live("geoloc_fuse", *self.summaries(), "--http", "0", "--out", self.objects_file) as fleet:
            url = url_of(fleet)
            fleet.wait_for("the page stays at")
            for name in SCREENS:
                page = self.open_screen(name, url)
                page.wait_for_selector("#flights tbody tr:nth-child(4)")
                lines = page.locator("#flights tbody tr").all_inner_texts()
                self.assertIn("its objects lie", lines[3])
                self.assertEqual([verdict in line for verdict, line in zip(("fused",) * 3 + ("quarantined",), lines)],
                                 [True] * 4)
                self.assertRegex(lines[0], r"[+−]\d\.\d\d ± \d\.\d\d")
                self.assertEqual(page.locator("#objects li[data-id]").count() > 0, True)
                self.assertIn("where a flight has it", page.locator("#layers").text_content())
                self.assertNotIn("footprint", page.locator("#layers").text_content())
                self.assertEqual(page.evaluate("document.documentElement.scrollWidth <= innerWidth"), True, name)
            self.assertEqual(self.faults, [])
            self.assertEqual(self.hosts, {url.split("/")[2]})
            self.assertEqual(fleet.interrupt(), 0)


if __name__ == "__main__":
    unittest.main()
