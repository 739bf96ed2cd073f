// SPDX-License-Identifier: MIT
// A person in front of the study's window, for tests: a real window on an X server of its own, keys
// pressed by xdotool.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace tests {

/// An Xvfb on a display number that is free. Throws std::runtime_error where it cannot be started.
class XServer {
  public:
    explicit XServer(const std::string& screen = "1280x800x24");
    ~XServer();
    XServer(const XServer&) = delete;
    XServer& operator=(const XServer&) = delete;
    const std::string& display() const { return display_; }  ///< ":99"

  private:
    pid_t process_ = -1;
    std::string display_;
};

/// study_app with its window, and the hands of its observer.
class WindowPerson {
  public:
    /// Starts study_app with the arguments; its files besides the data go into `folder`.
    WindowPerson(const XServer& server, const std::filesystem::path& folder,
                 std::vector<std::string> arguments,
                 const std::map<std::string, std::string>& environment = {});
    ~WindowPerson();  ///< kills it where it still runs
    WindowPerson(const WindowPerson&) = delete;
    WindowPerson& operator=(const WindowPerson&) = delete;

    /// The next line of the event log that begins with `beginning`; lines before it are passed by.
    /// Throws after 30 s without one, or where the program ends first.
    std::string waitFor(const std::string& beginning);
    /// The next line, whatever it is.
    std::string nextEvent() { return waitFor(""); }

    void press(const std::string& keys);  ///< as xdotool names them, separated by blanks
    void xdotool(const std::vector<std::string>& arguments) { onDisplay("xdotool", arguments); }
    /// Runs a tool of X on its display.
    void onDisplay(const std::string& tool, const std::vector<std::string>& arguments);
    std::string window();  ///< its id

    void kill();  ///< at once, as a power cut would
    /// kill() from another thread, in the middle of whatever goes on then.
    void killAfter(std::chrono::microseconds time);
    bool killed() const;  ///< and nothing else ended it
    bool killedWithin(std::chrono::milliseconds time);
    /// The disk is full for any file of more bytes than this.
    void limitFileSize(std::uintmax_t bytes);
    int exitCode();                           ///< waits for its end, at most 30 s
    std::vector<std::string> events() const;  ///< the whole log so far
    std::string errors() const;
    double processorSeconds() const;

  private:
    bool running();
    std::string outputOf(const std::vector<std::string>& command);
    pid_t process_ = -1;
    int exitCode_ = -1;
    std::string display_;
    std::filesystem::path log_, errors_;
    std::size_t read_ = 0;  // bytes of the log
    std::string windowId_;
    std::jthread killer_;
};

}  // namespace tests
