# SPDX-License-Identifier: MIT
# Calls the functions of an emitted module of Julia: julia calls.jl NAME calls.txt. The form of the calls is that of
# straight_line.py.
include(joinpath(pwd(), ARGS[1] * ".jl"))
scene = getfield(Main, Symbol(ARGS[1]))
earlier = Dict{String,Vector{Float64}}()
for line in eachline(ARGS[2])
    words = strip.(split(line, "|"))
    name, to = words[1], words[2]
    sizes = parse.(Int, split(words[3]))
    values = map(words[4:end]) do word
        startswith(word, "=") ? earlier[word[2:end]] :
        startswith(word, "[") ? parse.(Float64, split(word[2:end-1])) : parse(Float64, word)
    end
    results = [zeros(size) for size in sizes]
    call = getfield(scene, Symbol(name * "!"))
    if name == "prepare"
        results = [vcat(values[1], zeros(sizes[1] - length(values[1])))]
        call(results[1])
    else
        call(results..., values[2:end]..., values[1])
        println(join([string(x) for result in results for x in result], " "))
    end
    earlier[to] = results[1]
end
