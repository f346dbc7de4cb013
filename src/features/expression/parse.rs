use super::function::FUNCTIONS;
use super::tokens::{Token, Word, tokens};
use super::{Binary, CONSTANTS, ExpressionError, Mistake, Step, Variable};

/// How deep brackets, signs and powers may lie in each other: the parser calls itself for each.
const DEEPEST: usize = 60;

/// The steps that an expression's evaluation takes, see [`Expression`](super::Expression) for its grammar.
pub(super) fn steps(text: &str) -> Result<Vec<Step>, ExpressionError> {
    let mut parser = Parser { text, tokens: tokens(text)?, next: 0, depth: 0, steps: Vec::new() };
    if parser.peek().word == Word::End {
        return Err(parser.wrong(1, Mistake::Empty));
    }
    parser.sum()?;
    let rest = parser.peek();
    match &rest.word {
        Word::End => Ok(parser.steps),
        Word::Sign(')') => Err(parser.wrong(rest.column, Mistake::NotOpened)),
        Word::Sign(sign @ ',') => Err(parser.wrong(rest.column, Mistake::Character { character: *sign })),
        _ => Err(parser.wrong(rest.column, Mistake::NoOperator { found: rest.found() })),
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    next: usize,
    depth: usize,
    steps: Vec<Step>,
}

impl Parser<'_> {
    fn wrong(&self, column: usize, mistake: Mistake) -> ExpressionError {
        ExpressionError { text: self.text.to_string(), column, mistake }
    }

    /// The next word; at the end, the end.
    fn peek(&self) -> &Token {
        &self.tokens[self.next.min(self.tokens.len() - 1)]
    }

    fn take(&mut self) -> Token {
        let token = self.peek().clone();
        self.next += 1;
        token
    }

    /// Takes the next word if it is this sign.
    fn accept(&mut self, sign: char) -> bool {
        let is = self.peek().word == Word::Sign(sign);
        self.next += usize::from(is);
        is
    }

    /// One of the operators if it comes next.
    fn accept_any(&mut self, operators: &[(char, Binary)]) -> Option<Binary> {
        operators.iter().find(|(sign, _)| self.accept(*sign)).map(|&(_, binary)| binary)
    }

    /// Products with `+` and `-` between them.
    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.product()?;
        while let Some(binary) = self.accept_any(&[('+', Binary::Add), ('-', Binary::Subtract)]) {
            self.product()?;
            self.steps.push(Step::Binary(binary));
        }
        Ok(())
    }

    /// Signed powers with `*`, `/` and `%` between them.
    fn product(&mut self) -> Result<(), ExpressionError> {
        self.signed()?;
        let operators = [('*', Binary::Multiply), ('/', Binary::Divide), ('%', Binary::Remainder)];
        while let Some(binary) = self.accept_any(&operators) {
            self.signed()?;
            self.steps.push(Step::Binary(binary));
        }
        Ok(())
    }

    /// A power with signs before it. All nesting goes through here.
    fn signed(&mut self) -> Result<(), ExpressionError> {
        if self.depth >= DEEPEST {
            return Err(self.wrong(self.peek().column, Mistake::TooDeep));
        }
        self.depth += 1;
        let result = if self.accept('-') {
            self.signed().map(|()| self.steps.push(Step::Negate))
        } else if self.accept('+') {
            self.signed()
        } else {
            self.power()
        };
        self.depth -= 1;
        result
    }

    fn power(&mut self) -> Result<(), ExpressionError> {
        self.value()?;
        if self.accept('^') {
            self.signed()?;
            self.steps.push(Step::Binary(Binary::Power));
        }
        Ok(())
    }

    fn value(&mut self) -> Result<(), ExpressionError> {
        let token = self.take();
        match &token.word {
            Word::Number(number) => self.steps.push(Step::Number(*number)),
            Word::Name(name) => self.name(name, token.column)?,
            Word::Sign('(') => {
                self.sum()?;
                self.close(token.column)?;
            }
            _ => return Err(self.wrong(token.column, Mistake::NoValue { found: token.found() })),
        }
        Ok(())
    }

    /// The bracket that closes the one in a column.
    fn close(&mut self, opened: usize) -> Result<(), ExpressionError> {
        if self.accept(')') {
            return Ok(());
        }
        let next = self.peek();
        Err(match next.word {
            Word::End => self.wrong(opened, Mistake::NotClosed),
            Word::Sign(character) => self.wrong(next.column, Mistake::Character { character }),
            _ => self.wrong(next.column, Mistake::NoOperator { found: next.found() }),
        })
    }

    fn name(&mut self, name: &str, column: usize) -> Result<(), ExpressionError> {
        let called = self.peek().word == Word::Sign('(');
        if let Some(known) = FUNCTIONS.iter().find(|known| known.name == name) {
            if !called {
                return Err(self.wrong(column, Mistake::NoArguments { name: known.name }));
            }
            let given = self.arguments()?;
            let mistake = || Mistake::Arguments { name: known.name, takes: known.takes(), given };
            let function = known.with(given).ok_or_else(|| self.wrong(column, mistake()))?;
            self.steps.push(Step::Call(function));
            return Ok(());
        }
        let variable = Variable::ALL.iter().find(|(known, _)| *known == name).map(|&(_, v)| Step::Variable(v));
        let constant = CONSTANTS.iter().find(|(known, _)| *known == name).map(|&(_, number)| Step::Number(number));
        match variable.or(constant) {
            Some(_) if called => Err(self.wrong(column, Mistake::NotAFunction { name: name.to_string() })),
            Some(step) => {
                self.steps.push(step);
                Ok(())
            }
            None => Err(self.wrong(column, Mistake::Name { name: name.to_string() })),
        }
    }

    /// The arguments in brackets; gives their number.
    fn arguments(&mut self) -> Result<usize, ExpressionError> {
        let opened = self.take().column;
        if self.accept(')') {
            return Ok(0);
        }
        let mut given = 1;
        self.sum()?;
        while self.accept(',') {
            self.sum()?;
            given += 1;
        }
        self.close(opened)?;
        Ok(given)
    }
}
