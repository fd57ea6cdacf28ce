-- Where the results come from: the manifest, and the records of all runs.

local captions = require "captions"
local links = require "links"
local manifest = require "manifest"
local numbers = require "numbers"
local records = require "records"
local support = require "support"
local blocks = require "table_blocks"

local provenance = {}
local left, right = pandoc.AlignLeft, pandoc.AlignRight

local function source_link(program)
  local source = manifest.source_of(program)
  if support.katex then return {pandoc.Code(program)} end
  return {pandoc.Link({pandoc.Code(program)}, links.target(links.ship("sources/" .. source,
    support.source .. "/" .. source)))}
end

function provenance.manifest(block)
  local spec = support.settings(block, {caption = true})
  local rows = {}
  for i, row in ipairs(manifest.rows()) do
    rows[i] = {{pandoc.Str(row.item)}, {pandoc.Span({pandoc.Str(row.title)}, pandoc.Attr("", {"text"}))},
      source_link(row.program), {pandoc.Str(string.format("%.1f", records.load(row.program).seconds))}}
  end
  local caption, place = captions.make("Table", spec, "manifest")
  return blocks.layout(caption, place, {{pandoc.Str("in the chapter")}, {pandoc.Str("what it is")},
    {pandoc.Str("program")}, {pandoc.Str("seconds")}}, {left, left, left, right}, rows)
end

-- For the title: the day of the last result, and the commit if it is that of all.
function provenance.made_when()
  local latest, commit, several = "", nil, false
  for _, row in ipairs(manifest.rows()) do
    local record = records.load(row.program)
    if (record.finished or "") > latest then latest = record.finished end
    commit = commit or records.commit(record)
    several = several or commit ~= records.commit(record)
  end
  return pandoc.Inlines {pandoc.Str("Results of " .. latest:sub(1, 10) .. ", " ..
    (several and "from several commits, listed at the end" or "commit " .. (commit or "unknown")))}
end

-- The options of a run as one types them. The folders of the run are left out, others are those of the sources.
local function options_of(record)
  local options = {}
  for name, value in pairs(record.options or {}) do
    if name ~= "--out" and name ~= "--from" and value ~= false and value ~= "" then
      if type(value) == "string" then value = value:gsub("^/.*/(data/)", "%1") end
      options[#options + 1] = numbers.typed(name, value)
    end
  end
  table.sort(options)
  return options
end

function provenance.draw(block)
  local spec = support.settings(block, {caption = true})
  local rows, described, items, commits = {}, {}, {}, {}
  local function describe(name, value)
    local line = name .. ": " .. tostring(value)
    if value and not described[line] then
      described[line] = true
      items[#items + 1] = {pandoc.Plain {pandoc.Str(line)}}
    end
  end
  for i, row in ipairs(manifest.rows()) do
    local record = records.load(row.program)
    commits[records.commit(record)] = true
    local file = links.ship(records.path(row.program), string.format("%s/%s/%s.json", support.results, row.program,
      row.program))
    local finished = pandoc.Str((record.finished or ""):gsub("T", " "):gsub("Z", "") .. "")
    local options = pandoc.Inlines {}
    for _, option in ipairs(options_of(record)) do
      if #options > 0 then options:insert(pandoc.Space()) end
      options:insert(pandoc.Code(option))
    end
    rows[i] = {source_link(row.program), {support.katex and finished or pandoc.Link({finished}, links.target(file))},
      {pandoc.Span(options, pandoc.Attr("", {"text"}))}}
    describe("Compiler", string.format("%s, %s, %s", record.build.compiler, record.build.type, record.build.flags))
    for _, library in ipairs {"Eigen", "Boost", "NLopt", "Ipopt", "SuiteSparse", "gnuplot"} do
      if record.libraries[library] then
        describe(library, (record.libraries[library]:gsub("^gnuplot ", "")))
      end
    end
    describe("Processor", record.cores and string.format("%s, %d cores", record.processor, record.cores) or record.processor)
  end
  local names = {}
  for commit in pairs(commits) do names[#names + 1] = commit end
  table.sort(names)
  describe(#names > 1 and "Commits" or "Commit", table.concat(names, "; "))
  local caption, place = captions.make("Table", spec, "provenance")
  return {pandoc.BulletList(items), blocks.layout(caption, place, {{pandoc.Str("program")},
    {pandoc.Str("finished (UTC)")}, {pandoc.Str("options")}}, {left, left, left}, rows)}
end

return provenance
