-- What every part of the report's filter uses: the places it reads from, and one way to fail.

local support = {
  -- Set by report.lua from the command line: the folders of the results and of the sources, a file that lists those of
  -- the experiments, and, when the report is to be printed, the folder of KaTeX and one for pictures.
  results = nil, source = nil, listing = nil, katex = nil, pictures = nil,
  -- The page that is being drawn, such as 05_summary.md.
  page = nil,
}

-- Ends the build with one sentence, which names the page when one is being drawn.
function support.fail(...)
  local page = support.page and "/" .. support.page or ""
  io.stderr:write("paper" .. page .. ": " .. string.format(...) .. "\n")
  os.exit(1)
end

function support.read(path, hint)
  local file = io.open(path, "rb")
  if not file then support.fail("%s is not there%s.", path, hint or "") end
  local content = file:read("a")
  file:close()
  return content
end

function support.exists(path)
  local file = io.open(path, "rb")
  return file ~= nil and file:close()
end

function support.trim(text) return (text:gsub("^%s+", ""):gsub("%s+$", "")) end

-- The fields of a line of CSV; nothing where a quote is not closed.
function support.split_line(line)
  local fields, i = {}, 1
  while true do
    local field
    if line:sub(i, i) == '"' then
      local j = i + 1
      while true do
        j = line:find('"', j, true)
        if not j then return nil end
        if line:sub(j + 1, j + 1) ~= '"' then break end
        j = j + 2
      end
      field = line:sub(i + 1, j - 1):gsub('""', '"')
      i = j + 1
    else
      local j = line:find(",", i, true) or #line + 1
      field = line:sub(i, j - 1)
      i = j
    end
    fields[#fields + 1] = field
    if i > #line then return fields end
    i = i + 1
  end
end

-- The parts of "a | b | c", trimmed.
function support.fields(line)
  local parts = {}
  for part in (line .. "|"):gmatch("(.-)|") do parts[#parts + 1] = support.trim(part) end
  return parts
end

-- Markdown as inlines.
function support.inlines(markdown)
  local blocks = pandoc.read(markdown, "markdown").blocks
  return #blocks == 0 and pandoc.Inlines {} or pandoc.Inlines(pandoc.utils.blocks_to_inlines(blocks))
end

-- The lines "key: value" of a block; `allowed` lists the keys, `column` may come several times. A line that begins with
-- a blank goes on with the value above it.
function support.settings(block, allowed)
  local found, last = {column = {}}, nil
  for line in block.text:gmatch("[^\n]+") do
    local key, value = line:match("^(%w+):%s*(.*)$")
    if line:match("^%s") and last and last ~= "column" then
      found[last] = found[last] .. " " .. support.trim(line)
    elseif not key or not allowed[key] then
      support.fail("'%s' is not understood in a block of the report.", line)
    else
      if key == "column" then table.insert(found.column, value) else found[key] = value end
      last = key
    end
  end
  return found
end

return support
