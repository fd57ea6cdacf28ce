-- What the programs record about their runs: commit, options, libraries, machine, times.

local manifest = require "manifest"
local support = require "support"
-- Debian's package lua-dkjson, wherever LUA_PATH points.
package.path = package.path .. ";/usr/share/lua/5.3/?.lua"
local json = require "dkjson"

local records = {}
local loaded = {}

function records.path(program) return string.format("results/%s/%s.json", program, program) end

function records.load(program)
  if not loaded[program] then
    local path = string.format("%s/%s/%s.json", support.results, program, program)
    local record, position, reason = json.decode(support.read(path, manifest.hint(program)))
    if type(record) ~= "table" then support.fail("%s is not JSON at character %d: %s.", path, position or 1, reason) end
    loaded[program] = record
  end
  return loaded[program]
end

-- The value of an option in the run of a program.
function records.option(program, option)
  local value = (records.load(program).options or {})[option]
  if value == nil then support.fail("the program '%s' has no option '%s'.", program, option) end
  return value
end

-- A number that is built into a program.
function records.constant(program, name)
  local value = (records.load(program).constants or {})[name]
  if value == nil then support.fail("the program '%s' records no constant '%s'.", program, name) end
  return math.tointeger(value) or value
end

-- The commit a result was made from.
function records.commit(record)
  local origin = record.source or {}
  return (origin.commit and origin.commit:sub(1, 12) or "unknown") .. (origin.dirty and ", with changes" or "")
end

return records
