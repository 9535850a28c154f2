% SPDX-License-Identifier: MIT
% Calls the functions of an emitted file of MATLAB, in Octave: octave-cli calls.m NAME calls.txt. The form of the calls is that of
% straight_line.py.
given = argv();
scene = feval(given{1});
file = fopen(given{2});
earlier = struct();
line = fgetl(file);
while ischar(line)
    words = strtrim(strsplit(line, '|'));
    values = {};
    for k = 4:numel(words)
        if words{k}(1) == '='
            values{end + 1} = earlier.(words{k}(2:end));
        elseif words{k}(1) == '['
            values{end + 1} = sscanf(words{k}(2:end - 1), '%f');
        else
            values{end + 1} = str2double(words{k});
        end
    end
    results = cell(1, max(1, numel(strsplit(words{3}, ' '))));
    [results{:}] = scene.(words{1})(values{:});
    earlier.(words{2}) = results{1};
    if ~strcmp(words{1}, 'prepare')
        for k = 1:numel(results)
            assert(isreal(results{k}));
            printf('%.17g ', results{k});
        end
        printf('\n');
    end
    line = fgetl(file);
end
