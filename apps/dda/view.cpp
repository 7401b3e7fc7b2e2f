#include "view.hpp"

#include "call_error.hpp"
#include "exit_status.hpp"
#include "messages.hpp"
#include "result.hpp"
#include "view_histories.hpp"
#include "view_page.hpp"

#include <fmt/format.h>
#include <ddacontact/output/whole_file.hpp>
#include <ddacontact/page/page_data.hpp>

#include <filesystem>

namespace dda {

namespace fs = std::filesystem;
using namespace ddacontact;

namespace {

PageStory story_of(const fs::path& directory) {
  return {.title = title_of(directory, scene_of(directory)),
          .program = "polydda " POLYDDA_VERSION,
          .verdict = verdict_of(directory),
          .block_names = block_names(directory),
          .histories = histories_of(directory)};
}

PageData data_of(const fs::path& directory) {
  const FrameSeries series = read_series(directory);
  PageBuilder page(series.size());
  for (const FrameFile& file : series) page.add(read_frame(file));
  return page.finish(story_of(directory));
}

/// A part of the run where scripts of the page find it. Base64 and JSON without "<" need no escapes.
void write_data(std::ostream& out, const std::string& id, const std::string& text) {
  out << "<script type=\"text/plain\" id=\"" << id << "\">" << text << "</script>\n";
}

std::string without_tags(const std::string& json) {
  std::string text;
  for (const char c : json) text += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return text;
}

/// What the page shows first, its head and the last frames, stands before its script; the rest after it, so
/// that a picture is there before all is read.
void write_page(std::ostream& out, const PageData& data) {
  const std::string_view page = view_page();
  const std::size_t first = page.find(first_data_mark), more = page.find(more_data_mark);
  out << page.substr(0, first);
  write_data(out, "head", without_tags(data.head));
  const auto write_shape = [&](std::size_t k) {
    write_data(out, "shape" + std::to_string(k), data.shapes[k]);
  };
  const auto write_chunk = [&](std::size_t k) {
    write_data(out, "chunk" + std::to_string(k), data.chunks[k]);
  };
  write_shape(data.shapes.size() - 1);
  write_chunk(data.chunks.size() - 1);
  const std::size_t after = first + first_data_mark.size();
  out << page.substr(after, more - after);
  for (std::size_t k = 0; k + 1 < data.shapes.size(); ++k) write_shape(k);
  for (std::size_t k = 0; k + 1 < data.chunks.size(); ++k) write_chunk(k);
  out << page.substr(more + more_data_mark.size());
}

void check_call(const ViewArguments& call) {
  const fs::path ending = fs::path(call.output).extension();
  if (ending != ".html" && ending != ".htm")
    throw CallError(fmt::format("-o \"{}\": the page is HTML, so the name must end in .html", call.output));
}

}  // namespace

void add_view(CLI::App& app, ViewArguments& call) {
  CLI::App* view = app.add_subcommand("view", "Write a web page that shows a result, frame by frame");
  view->add_option("DIR", call.directory, "Result directory")->required();
  view->add_option("-o,--output", call.output, "The page to write, .html; it needs no other file")
      ->required()
      ->type_name("FILE");
}

int view(const ViewArguments& call) {
  try {
    check_call(call);
    expect_result_directory(call.directory);
    const PageData data = data_of(call.directory);
    write_whole(call.output, [&](std::ostream& out) { write_page(out, data); });
    return done;
  } catch (const CallError& error) {
    print_error(error.what());
    return wrong_input;
  } catch (const Error& error) {
    print_error(error.what());
    return file_error;
  }
}

}  // namespace dda
