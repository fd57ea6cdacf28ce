-- Captions: numbered one after the other, with what the table or figure is in the thesis and where it comes from.

local links = require "links"
local manifest = require "manifest"
local support = require "support"
local values = require "values"

local captions = {}
local counts, known = {Table = 0, Figure = 0}, {}

-- What a table or figure has below its caption: its data, its source and the command that makes it.
local function origin(files, program)
  local parts = pandoc.Inlines {}
  local function add(label, inline)
    if #parts > 0 then parts:extend {pandoc.Str(" · ")} end
    parts:extend {pandoc.Str(label .. " "), inline}
  end
  if not support.katex then
    for _, file in ipairs(files) do
      add(file:match("%.svg$") and "Picture:" or "Data:", pandoc.Link({pandoc.Code((file:match("[^/]+$")))}, links.target(file)))
    end
  elseif not program then
    add("Data:", pandoc.Code(files[1]))
  end
  if program then
    local source = manifest.source_of(program)
    if not support.katex then
      local shipped = links.ship("sources/" .. source, support.source .. "/" .. source)
      add("Source:", pandoc.Link({pandoc.Code((source:match("[^/]+$")))}, links.target(shipped)))
    end
    add("Command:", pandoc.Code(manifest.command(program)))
  end
  return pandoc.Span(parts, pandoc.Attr("", {"made"}))
end

-- The caption of a table or figure, and its place for links. `kind` is Table or Figure, `spec` the block's settings.
function captions.make(kind, spec, name, files, program)
  counts[kind] = counts[kind] + 1
  local label = kind .. "\u{a0}" .. counts[kind]
  local place = (kind == "Table" and "tab-" or "fig-") .. (spec.id or name:gsub("/", "-"))
  if known[place] then place = place .. "-" .. counts[kind] end
  known[place] = label
  local caption = pandoc.Inlines {pandoc.Strong {pandoc.Str(label)}}
  if spec.thesis then caption:extend {pandoc.Str(" (" .. spec.thesis:gsub(" ", "\u{a0}") .. " of the chapter)")} end
  caption:insert(pandoc.Str("."))
  if spec.caption then
    caption:insert(pandoc.Space())
    caption:extend(values.inlines(spec.caption))
  end
  if files or program then
    caption:insert(pandoc.Space())
    caption:insert(origin(files or {}, program))
  end
  return caption, place, label
end

-- Links without a text get that of the table or figure they lead to.
function captions.name_links(document)
  return document:walk {
    Link = function(link)
      if #link.content > 0 then return nil end
      local label = known[link.target:sub(2)] or
        support.fail("the link to '%s' has no text, and leads to no table or figure.", link.target)
      link.content = {pandoc.Str(label)}
      return link
    end,
  }
end

return captions
