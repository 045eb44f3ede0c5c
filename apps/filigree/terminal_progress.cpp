#include "terminal_progress.h"

#include "filigree/report/number.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace filigree::app {
namespace {

volatile std::sig_atomic_t stopped = 0;

void noteSignal(int signal) {
    stopped = 1;
    std::signal(signal, SIG_DFL);
}

unsigned terminalColumns() {
    winsize size{};
    return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string minutes(double seconds) {
    const auto whole = static_cast<uint64_t>(std::min(seconds, 359'999.0) + 0.5);
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

constexpr auto interval = std::chrono::milliseconds(100);
constexpr unsigned widestBar = 30;

}  // namespace

void stopOnSignals() {
    std::signal(SIGINT, noteSignal);
    std::signal(SIGTERM, noteSignal);
}

TerminalProgress::TerminalProgress(bool wanted) : drawn_(wanted && isatty(STDERR_FILENO) != 0) {}

void TerminalProgress::begin(std::string_view stage, uint64_t total, std::string_view unit) {
    const std::lock_guard lock(mutex_);
    stage_ = stage;
    unit_ = unit;
    total_ = total;
    done_ = 0;
    started_ = Clock::now();
    next_ = started_ + interval;
}

void TerminalProgress::advance(uint64_t units) {
    done_ += units;
    if (!drawn_) return;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    const auto now = Clock::now();
    if (!lock || now < next_) return;
    next_ = now + interval;
    draw(now);
}

void TerminalProgress::end() {
    const std::lock_guard lock(mutex_);
    if (visible_) std::fputs("\r\033[K", stderr);
    visible_ = false;
}

bool TerminalProgress::cancelled() const {
    return stopped != 0;
}

void TerminalProgress::draw(Clock::time_point now) {
    const double seconds = std::chrono::duration<double>(now - started_).count();
    const auto line = progressLine(stage_, done_, total_, unit_, seconds, terminalColumns() - 1);
    fmt::print(stderr, "\r{}\033[K", line);
    visible_ = true;
}

std::string progressLine(std::string_view stage, uint64_t done, uint64_t total, std::string_view unit,
                         double seconds, unsigned columns) {
    const double share =
        total > 0 ? std::min(1.0, static_cast<double>(done) / static_cast<double>(total)) : 0;
    const double rate = seconds > 0 ? static_cast<double>(done) / seconds : 0;
    std::string tail = fmt::format(" {:3.0f} %, {} {}/s", share * 100, report::formatCompact(rate), unit);
    if (share > 0) tail += fmt::format(", {} left", minutes(seconds * (1 - share) / share));
    std::string line(stage);
    const size_t room = columns > line.size() + tail.size() + 3 ? columns - line.size() - tail.size() - 3 : 0;
    if (const size_t bar = std::min<size_t>(room, widestBar); bar >= 5) {
        const auto full = static_cast<size_t>(share * static_cast<double>(bar));
        line += " [" + std::string(full, '#') + std::string(bar - full, '-') + "]";
    }
    line += tail;
    if (line.size() > columns) line.resize(columns);
    return line;
}

}  // namespace filigree::app
