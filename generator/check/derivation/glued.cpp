// SPDX-License-Identifier: GPL-2.0-or-later
#include "check/derivation/glued.hpp"

#include <algorithm>

#include "check/derivation/claim_text.hpp"

namespace alembert {

namespace {

using Kind = Math::Kind;

class Ungluing {
public:
    Ungluing(const Written& written, const Letters& letters) : letters_(letters) {
        for (const WrittenStatement& statement : written.statements)
            for (const MathPtr& side : statement.sides)
                if (side->kind == Kind::letter) named_.insert(side->letter);  // mgl = 3: a letter of its own
    }

    MathPtr of(const MathPtr& math) const {
        switch (math->kind) {
            case Kind::letter:
            case Kind::applied: {
                const std::vector<MathPtr> factors = factors_of(math, nullptr);
                return factors.size() == 1 ? factors[0] : joined(*math, factors);
            }
            case Kind::power: {
                std::vector<MathPtr> factors = factors_of(math->args[0], nullptr);
                const bool is_word = math->args[0]->kind == Kind::letter && factors.size() > 1;
                Math power = *math;
                power.args = {is_word ? factors.back() : of(math->args[0]), of(math->args[1])};
                if (!is_word) return made(std::move(power));
                factors.back() = made(std::move(power));
                return joined(*math, factors);
            }
            case Kind::product:
                return of_product(*math);
            default: {
                Math copy = *math;
                for (MathPtr& arg : copy.args) arg = of(arg);
                return made(std::move(copy));
            }
        }
    }

private:
    static MathPtr made(Math math) {
        for (const MathPtr& arg : math.args) math.levels = std::max(math.levels, arg->levels + 1);
        return std::make_shared<Math>(std::move(math));
    }
    static MathPtr joined(const Math& like, std::vector<MathPtr> factors) {
        Math product{.kind = Kind::product};
        product.args = std::move(factors);
        product.offset = like.offset, product.length = like.length;
        return made(std::move(product));
    }

    MathPtr of_product(const Math& product) const {
        std::vector<MathPtr> factors;
        for (std::size_t k = 0; k < product.args.size(); ++k) {
            const MathPtr next = k + 1 < product.args.size() ? of(product.args[k + 1]) : nullptr;
            const bool is_word = product.args[k]->kind == Kind::letter;
            const std::vector<MathPtr> own =
                is_word ? factors_of(product.args[k], next) : std::vector<MathPtr>{of(product.args[k])};
            factors.insert(factors.end(), own.begin(), own.end());
            if (next && own.back()->kind == Kind::call && own.back()->args[0] == next) ++k;  // the sine's argument
        }
        return joined(product, std::move(factors));
    }

    /// The factors of a letter or an applied one; itself if it is no word of several. `next`: what a function at
    /// the end of the word is taken of.
    std::vector<MathPtr> factors_of(const MathPtr& math, const MathPtr& next) const {
        if ((math->kind != Kind::letter && math->kind != Kind::applied) || math->letter.base.size() < 2 ||
            letters_.name_of(math->letter) || named_.contains(math->letter))
            return {unchanged(math)};
        std::string word = math->letter.base, function;
        if (next)
            for (const char* const known : {"sin", "cos", "tan", "cot"})
                if (word.ends_with(known) && word.size() > 3) function = known;
        word.resize(word.size() - function.size());
        std::vector<std::string> pieces;
        if (!split(word, pieces) || (pieces.size() < 2 && function.empty())) return {unchanged(math)};
        std::vector<MathPtr> result;
        for (std::size_t k = 0; k < pieces.size(); ++k) {
            const bool is_last = k + 1 == pieces.size() && function.empty();
            Math piece{.kind = is_last ? math->kind : Kind::letter};
            piece.letter.base = pieces[k];
            if (is_last) {
                piece.letter.index = math->letter.index, piece.dots = math->dots;
                for (const MathPtr& arg : math->args) piece.args.push_back(of(arg));
            }
            piece.offset = math->offset, piece.length = math->length;
            result.push_back(made(std::move(piece)));
        }
        if (!function.empty()) {
            Math call{.kind = Kind::call};
            call.text = function;
            call.args = {next};
            call.offset = math->offset, call.length = next->offset + next->length - math->offset;
            result.push_back(made(std::move(call)));
        }
        return result;
    }

    MathPtr unchanged(const MathPtr& math) const {
        if (math->args.empty()) return math;
        Math copy = *math;
        for (MathPtr& arg : copy.args) arg = of(arg);
        return made(std::move(copy));
    }

    /// Into letters of the scene, the longest first.
    bool split(const std::string& word, std::vector<std::string>& pieces) const {
        if (word.empty()) return true;
        for (std::size_t length = word.size(); length > 0; --length) {
            Letter letter;
            letter.base = word.substr(0, length);
            const auto name = letters_.name_of(letter);
            if (!name || !letters_.is_of_scene(*name)) continue;
            pieces.push_back(letter.base);
            if (split(word.substr(length), pieces)) return true;
            pieces.pop_back();
        }
        return false;
    }

    const Letters& letters_;
    std::set<Letter> named_;
};

}  // namespace

Written with_products(Written written, const Letters& letters) {
    const Ungluing ungluing(written, letters);
    for (WrittenStatement& statement : written.statements)
        for (MathPtr& side : statement.sides) side = ungluing.of(side);
    return written;
}

}  // namespace alembert
