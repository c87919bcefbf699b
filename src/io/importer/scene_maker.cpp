// SPDX-License-Identifier: Apache-2.0
#include "io/importer/scene_maker.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <stop_token>
#include <system_error>
#include <utility>
#include <vector>

#include "io/gltf/container.hpp"
#include "io/importer/host/import_host.hpp"
#include "io/source/input_file.hpp"
#include "strake/parallel/for_each.hpp"
#include "strake/parallel/progress.hpp"

namespace strake::io {
namespace {

namespace fs = std::filesystem;

/// Of the way in which importers are called and answer: scenes of another are not taken.
constexpr std::uint32_t kContract = 1;

/// The parts that the progress of one file is counted in.
constexpr double kParts = 1000;

Result<Hash128> hash_of(const fs::path& file) {
  const Result<FileContent> content = FileContent::read(file);
  if (!content) return content.error();
  return hash_bytes(content->bytes());
}

std::vector<FileStamp> stamps_of(const ImporterProgram& program, const SceneFacts& facts) {
  std::vector<FileStamp> stamps{stamp_of(program.file)};
  for (const std::string& file : facts.depends_on)
    if (fs::path(file).is_absolute()) stamps.push_back(stamp_of(file));
  return stamps;
}

}  // namespace

SceneMaker::SceneMaker(ImportSettings settings) : settings_(std::move(settings)) {
  if (settings_.cache) cache_.emplace(*settings_.cache, settings_.cache_bytes);
}

std::optional<SceneJob> SceneMaker::job_of(const FileBytes& file) const {
  std::optional<ImporterProgram> program = find_importer(file, settings_.folders);
  if (!program) return std::nullopt;
  const FileStamp stamp = stamp_of(program->file);
  const Hash128 content = hash_bytes(file.bytes);
  Hasher key;
  key.add(kContract).add(content.high).add(content.low).add(stamp.path);
  key.add(stamp.size).add(stamp.time).add(program->suffix);
  if (settings_.sag_mm) key.add(*settings_.sag_mm);
  return SceneJob{file.path, std::move(*program), content, key.value()};
}

std::optional<ImportedScene> SceneMaker::find(const SceneJob& job) const {
  if (!cache_) return std::nullopt;
  std::optional<EntryFacts> facts = cache_->find(job.key);
  if (!facts) return std::nullopt;
  cache_->touch(job.key);
  ImportedScene scene;
  scene.path = cache_->file_of(job.key);
  scene.facts = std::move(*facts);
  scene.is_kept = true;
  return scene;
}

/// Finds the place for a scene: beside those that are kept, so that it can be moved there, or where
/// temporary files are.
SceneMaker::Place SceneMaker::place_for(const SceneJob& job) const {
  // A scene is rarely larger than its file; a disk that fills while an importer writes makes it
  // fail.
  constexpr std::uintmax_t kSpare = 32U << 20U;
  std::error_code failed;
  Place place;
  if (cache_) {
    place.trouble = cache_->open();
    if (!place.trouble) {
      const std::uintmax_t room = fs::space(*settings_.cache, failed).available;
      if (!failed && room < kSpare + 2 * fs::file_size(job.file, failed))
        place.trouble = "there is too little room on the disk";
    }
    if (!place.trouble) place.work = WorkFolder::make(*settings_.cache);
    place.may_be_kept = place.work != nullptr;
    if (!place.may_be_kept && !place.trouble) place.trouble = "no folder can be made";
  }
  if (!place.work) {
    const fs::path temporary = fs::temp_directory_path(failed);
    if (!failed) place.work = WorkFolder::make(temporary);
  }
  return place;
}

void SceneMaker::keep(const SceneJob& job, std::span<const std::byte> bytes,
                      ImportedScene& scene) const {
  scene.trouble = cache_->keep(job.key, scene.path, bytes, scene.facts);
  if (scene.trouble) return;
  scene.path = cache_->file_of(job.key);
  scene.is_kept = true;
  scene.work.reset();
}

Result<ImportedScene> SceneMaker::make(const SceneJob& job, const ImportRunOptions& options) const {
  Place place = place_for(job);
  if (!place.work)
    return Error{ErrorCode::output, "there is no folder in which its importer could work",
                 job.file.string(), "let TMPDIR name a folder that you may write to"};
  Result<SceneFacts> facts = run_importer(
      {job.program, job.file, place.work->path(), settings_.silence_s, settings_.sag_mm}, options);
  if (!facts) return facts.error();
  const Result<Hash128> now = hash_of(job.file);
  if (!now) return now.error();
  if (*now != job.content)
    return Error{ErrorCode::input, "is being written while it is read", job.file.string(),
                 "try again when it is whole"};
  ImportedScene scene;
  scene.path = scene_file(place.work->path());
  scene.work = std::move(place.work);
  scene.trouble = std::move(place.trouble);
  scene.facts.file = job.file.filename().string();
  scene.facts.importer = stamps_of(job.program, *facts);
  scene.facts.scene = std::move(*facts);
  const Result<FileContent> content = FileContent::read(scene.path);
  if (!content) return content.error();
  if (!gltf::has_glb_magic(content->bytes()))
    return Error{ErrorCode::input,
                 job.program.file.filename().string() + " made something that is no GLB",
                 job.file.string(), "tell the importer's author of it"};
  if (place.may_be_kept) keep(job, content->bytes(), scene);
  return scene;
}

namespace {

/// By the programs of importers.
using ImportHosts = std::map<fs::path, std::unique_ptr<ImportHost>>;

/// Starts what imports several files of one importer; a file that is alone has its importer.
ImportHosts hosts_for(std::span<const SceneJob* const> jobs) {
  std::map<fs::path, std::size_t> files;
  for (const SceneJob* const job : jobs) ++files[job->program.file];
  ImportHosts hosts;
  for (const SceneJob* const job : jobs) {
    if (files[job->program.file] < 2 || hosts.contains(job->program.file)) continue;
    const fs::path program = program_for_several(job->program);
    if (program.empty()) continue;
    if (auto host = ImportHost::start(program)) hosts.emplace(job->program.file, std::move(host));
  }
  return hosts;
}

/// What is reported of files that are imported at the same time.
std::string phase_of(std::span<const SceneJob* const> jobs) {
  return jobs.size() == 1 ? "import " + jobs.front()->file.filename().string()
                          : "import " + std::to_string(jobs.size()) + " files";
}

}  // namespace

ImportedScenes SceneMaker::make_all(std::span<const SceneJob> jobs,
                                    const parallel::Context& context) const {
  ImportedScenes scenes;
  std::vector<const SceneJob*> to_make;
  for (const SceneJob& job : jobs) {
    if (scenes.contains(job.key)) continue;
    std::optional<ImportedScene> kept = find(job);
    if (!kept) to_make.push_back(&job);
    scenes.emplace(job.key, kept ? Result<ImportedScene>(std::move(*kept))
                                 : Error{ErrorCode::cancelled, "reading was cancelled",
                                         job.file.string(), ""});
  }
  if (to_make.empty()) return scenes;
  const parallel::ProgressPhase shown(context.progress, phase_of(to_make),
                                      to_make.size() * static_cast<std::uint64_t>(kParts));
  const auto workers = static_cast<std::size_t>(parallel::workers_of(context));
  const auto threads =
      static_cast<unsigned>(std::max<std::size_t>(1, workers / std::min(workers, to_make.size())));
  const ImportHosts hosts = hosts_for(to_make);
  std::vector<std::stop_source> given_up(to_make.size());
  const Status done = parallel::for_each(
      context, {.name = "import files", .n = to_make.size()}, [&](std::size_t i) {
        if (given_up[i].stop_requested()) return;
        std::uint64_t reported = 0;
        const auto progress = [&](double part) {
          const auto parts = static_cast<std::uint64_t>(part * kParts);
          // A file that lost its host begins anew.
          if (parts > reported) shown.add(parts - std::exchange(reported, parts));
        };
        Result<ImportedScene>& scene = scenes.at(to_make[i]->key);
        const auto host = hosts.find(to_make[i]->program.file);
        scene = make(*to_make[i], {threads, progress, context.stop, given_up[i].get_token(),
                                   host == hosts.end() ? nullptr : host->second.get()});
        if (scene) return;
        for (std::size_t later = i + 1; later < given_up.size(); ++later)
          given_up[later].request_stop();
      });
  // The run was cancelled, or there was no memory: that is why others lack.
  for (const SceneJob* const job : to_make)
    if (Result<ImportedScene>& scene = scenes.at(job->key);
        !done && !scene && scene.error().code == ErrorCode::cancelled)
      scene = done.error();
  return scenes;
}

void SceneMaker::forget(const Hash128& key) const {
  if (cache_) cache_->remove(key);
}

}  // namespace strake::io
