-- The manifest of the experiments: which program makes a result, by which command, from which source file.

local support = require "support"

local manifest = {}
local rows, sources

function manifest.rows()
  if rows then return rows end
  rows = {}
  for line in pandoc.pipe(support.source .. "/scripts/manifest", {"rows"}, ""):gmatch("[^\n]+") do
    local program, item, title = line:match("^(.-)|(.-)|(.-)|")
    rows[#rows + 1] = {program = program, item = item, title = title}
  end
  return rows
end

-- The program a result belongs to: the longest name in the manifest that the result's name begins with.
function manifest.program_of(name)
  local found
  for _, row in ipairs(manifest.rows()) do
    local begins = name == row.program or name:sub(1, #row.program + 1) == row.program .. "_"
    if begins and (not found or #row.program > #found) then found = row.program end
  end
  if not found then support.fail("the manifest has no program for the result '%s'.", name) end
  return found
end

-- The synthesis that a table of the thesis is about, SO, MO or D for 5.3, 5.4 or 5.5: its title begins with it.
function manifest.synthesis_of(table)
  for _, row in ipairs(manifest.rows()) do
    local synthesis = row.item == "Table " .. table and row.title:match("^(%u+) synthesis")
    if synthesis then return synthesis end
  end
end

function manifest.command(program) return "make experiment NAME=" .. program end

function manifest.hint(program) return "; run '" .. manifest.command(program) .. "' first" end

-- The source file of a program, below the folder of the sources. paper/build lists the files of experiments.
function manifest.source_of(program)
  if not sources then
    sources = {}
    for path in support.read(support.listing):gmatch("[^\n]+") do
      local name = path:match("([^/]+)%.cpp$")
      if name then sources[name] = path end
    end
  end
  return sources[program] or support.fail("the program '%s' has no source file below experiments.", program)
end

return manifest
