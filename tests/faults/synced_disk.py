# SPDX-License-Identifier: Apache-2.0
"""What a power cut leaves of a folder: only what was synced before it (disk_shim.cpp notes that)."""
import collections
import os
import pathlib

Sync = collections.namedtuple("Sync", "at_ns kind inode copy")


class SyncedDisk:
    """`root` existed before the program began; `store` is where the shim keeps what was synced."""

    def __init__(self, root, store):
        self._root_inode = os.stat(root).st_ino
        self._store = pathlib.Path(store)
        lines = (self._store / "syncs").read_text().splitlines()
        self.syncs = [Sync(int(at), kind, int(inode), copy) for at, kind, inode, copy in map(str.split, lines)]

    def lay_out(self, cut_ns, folder, zeros=0):
        """Makes `folder` what a cut at that time leaves. A file that was never synced is empty; `zeros` are added to
        each file, as a file system leaves whose metadata was ahead of its data."""
        newest = {sync.inode: sync for sync in self.syncs if sync.at_ns <= cut_ns}
        self._lay_out_folder(newest, self._root_inode, pathlib.Path(folder), zeros)

    def _lay_out_folder(self, newest, inode, folder, zeros):
        folder.mkdir()
        if inode not in newest:
            return
        for line in (self._store / newest[inode].copy).read_text().splitlines():
            entry_inode, kind, name = line.split(" ", 2)
            if name in (".", ".."):
                continue
            if kind == "folder":
                self._lay_out_folder(newest, int(entry_inode), folder / name, zeros)
            else:
                sync = newest.get(int(entry_inode))
                content = (self._store / sync.copy).read_bytes() if sync else b""
                (folder / name).write_bytes(content + bytes(zeros))
