// SPDX-License-Identifier: Apache-2.0
// Loaded by LD_PRELOAD into the program under test; it stands between the program and its disk.
//
// GEOLOC_SYNCED=FOLDER: what each fsync() and fdatasync() has made safe is written there, so that the test
// can lay out what a power cut leaves (synced_disk.py). A line of FOLDER/syncs tells the time (UTC, ns),
// `file` or `folder`, the inode, and the name in FOLDER of a copy of the content: bytes, or lines of inode,
// kind and name.
//
// GEOLOC_STALL=FILE: while FILE exists, writes to files of a recording and their syncs do not return.
//
// GEOLOC_FULL=1: the disk takes no new folder.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <thread>

namespace {

template <typename Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

bool is_kind(int descriptor, mode_t kind) {
  struct stat status {};
  return fstat(descriptor, &status) == 0 && (status.st_mode & S_IFMT) == kind;
}

std::string path_of(int descriptor) {
  return "/proc/self/fd/" + std::to_string(descriptor);
}

void copy_file(int descriptor, const std::string& copy) {
  std::ofstream(copy, std::ios::binary) << std::ifstream(path_of(descriptor), std::ios::binary).rdbuf();
}

void list_folder(int descriptor, const std::string& copy) {
  std::ofstream list(copy, std::ios::binary);
  DIR* const folder = opendir(path_of(descriptor).c_str());
  while (const dirent* const entry = readdir(folder))
    list << entry->d_ino << (entry->d_type == DT_DIR ? " folder " : " file ") << entry->d_name << '\n';
  closedir(folder);
}

void note_synced(int descriptor, const std::string& store) {
  static std::atomic<int> count{0};
  const bool is_folder = is_kind(descriptor, S_IFDIR);
  struct stat status {};
  if (fstat(descriptor, &status) != 0) return;
  const std::string copy = "sync-" + std::to_string(++count);
  (is_folder ? list_folder : copy_file)(descriptor, store + "/" + copy);
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::string line = std::to_string(std::chrono::duration_cast<std::chrono::nanoseconds>(now).count()) +
                           (is_folder ? " folder " : " file ") + std::to_string(status.st_ino) + " " + copy +
                           "\n";
  std::ofstream(store + "/syncs", std::ios::app | std::ios::binary) << line;
}

/// The files that grow in a recording: the program's other files, and its sockets and pipes, are not stalled.
bool is_log(int descriptor) {
  char target[4096];
  const ssize_t size = readlink(path_of(descriptor).c_str(), target, sizeof target);
  return size > 0 &&
         std::string(target, static_cast<std::size_t>(size)).find(".partial/") != std::string::npos;
}

void stall(int descriptor) {
  const char* const gate = std::getenv("GEOLOC_STALL");
  if (gate == nullptr || !is_log(descriptor)) return;
  while (access(gate, F_OK) == 0) std::this_thread::sleep_for(std::chrono::milliseconds{10});
}

int sync_and_note(int descriptor, const char* function) {
  stall(descriptor);
  const int status = next<int(int)>(function)(descriptor);
  const char* const store = std::getenv("GEOLOC_SYNCED");
  if (store != nullptr && status == 0) note_synced(descriptor, store);
  return status;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, std::size_t size) {
  stall(descriptor);
  return next<ssize_t(int, const void*, std::size_t)>("write")(descriptor, bytes, size);
}

int mkdir(const char* path, mode_t mode) {
  if (std::getenv("GEOLOC_FULL") == nullptr) return next<int(const char*, mode_t)>("mkdir")(path, mode);
  errno = ENOSPC;
  return -1;
}

int fsync(int descriptor) {
  return sync_and_note(descriptor, "fsync");
}

int fdatasync(int descriptor) {
  return sync_and_note(descriptor, "fdatasync");
}

}  // extern "C"
