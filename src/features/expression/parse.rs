use super::error::{ExpressionError, Mistake};
use super::function::FUNCTIONS;
use super::instruction::{Binary, Instruction};
use super::tokens::{Token, TokenKind, tokens};
use super::variables::{CONSTANTS, Variable};

/// Greatest nesting of brackets, signs and powers: the parser recurses for each.
const DEEPEST: usize = 60;

/// Compiles an expression, see [`Expression`](super::Expression) for its grammar.
pub(super) fn instructions(text: &str) -> Result<Vec<Instruction>, ExpressionError> {
    let mut parser = Parser { text, tokens: tokens(text)?, next: 0, depth: 0, instructions: Vec::new() };
    if parser.peek().kind == TokenKind::End {
        return Err(parser.wrong(1, Mistake::Empty));
    }
    parser.sum()?;
    let rest = parser.peek();
    match &rest.kind {
        TokenKind::End => Ok(parser.instructions),
        TokenKind::Sign(')') => Err(parser.wrong(rest.column, Mistake::NotOpened)),
        TokenKind::Sign(sign @ ',') => Err(parser.wrong(rest.column, Mistake::Character { character: *sign })),
        _ => Err(parser.wrong(rest.column, Mistake::NoOperator { found: rest.found() })),
    }
}

struct Parser<'a> {
    text: &'a str,
    tokens: Vec<Token>,
    next: usize,
    depth: usize,
    instructions: Vec<Instruction>,
}

impl Parser<'_> {
    fn wrong(&self, column: usize, mistake: Mistake) -> ExpressionError {
        ExpressionError { text: self.text.to_string(), column, mistake }
    }

    /// The next token; [`TokenKind::End`] at the end.
    fn peek(&self) -> &Token {
        &self.tokens[self.next.min(self.tokens.len() - 1)]
    }

    fn take(&mut self) -> Token {
        let token = self.peek().clone();
        self.next += 1;
        token
    }

    /// Takes the next token if it is this sign.
    fn accept(&mut self, sign: char) -> bool {
        let is = self.peek().kind == TokenKind::Sign(sign);
        self.next += usize::from(is);
        is
    }

    /// Takes the next token if it is one of the operators.
    fn accept_any(&mut self, operators: &[(char, Binary)]) -> Option<Binary> {
        operators.iter().find(|(sign, _)| self.accept(*sign)).map(|&(_, binary)| binary)
    }

    /// Parses products with `+` and `-` between them.
    fn sum(&mut self) -> Result<(), ExpressionError> {
        self.product()?;
        while let Some(binary) = self.accept_any(&[('+', Binary::Add), ('-', Binary::Subtract)]) {
            self.product()?;
            self.instructions.push(Instruction::Binary(binary));
        }
        Ok(())
    }

    /// Parses signed powers with `*`, `/` and `%` between them.
    fn product(&mut self) -> Result<(), ExpressionError> {
        self.signed()?;
        let operators = [('*', Binary::Multiply), ('/', Binary::Divide), ('%', Binary::Remainder)];
        while let Some(binary) = self.accept_any(&operators) {
            self.signed()?;
            self.instructions.push(Instruction::Binary(binary));
        }
        Ok(())
    }

    /// Parses a power with signs before it. All nesting goes through here.
    fn signed(&mut self) -> Result<(), ExpressionError> {
        if self.depth >= DEEPEST {
            return Err(self.wrong(self.peek().column, Mistake::TooDeep));
        }
        self.depth += 1;
        let result = if self.accept('-') {
            self.signed().map(|()| self.instructions.push(Instruction::Negate))
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
            self.instructions.push(Instruction::Binary(Binary::Power));
        }
        Ok(())
    }

    fn value(&mut self) -> Result<(), ExpressionError> {
        let token = self.take();
        match &token.kind {
            TokenKind::Number(number) => self.instructions.push(Instruction::Number(*number)),
            TokenKind::Name(name) => self.name(name, token.column)?,
            TokenKind::Sign('(') => {
                self.sum()?;
                self.close(token.column)?;
            }
            _ => return Err(self.wrong(token.column, Mistake::NoValue { found: token.found() })),
        }
        Ok(())
    }

    /// Expects the bracket that closes the one in a column.
    fn close(&mut self, opened: usize) -> Result<(), ExpressionError> {
        if self.accept(')') {
            return Ok(());
        }
        let next = self.peek();
        Err(match next.kind {
            TokenKind::End => self.wrong(opened, Mistake::NotClosed),
            TokenKind::Sign(character) => self.wrong(next.column, Mistake::Character { character }),
            _ => self.wrong(next.column, Mistake::NoOperator { found: next.found() }),
        })
    }

    fn name(&mut self, name: &str, column: usize) -> Result<(), ExpressionError> {
        let called = self.peek().kind == TokenKind::Sign('(');
        if let Some(known) = FUNCTIONS.iter().find(|known| known.name == name) {
            if !called {
                return Err(self.wrong(column, Mistake::NoArguments { name: known.name }));
            }
            let given = self.arguments()?;
            let mistake = || Mistake::Arguments { name: known.name, takes: known.takes(), given };
            let function = known.with_arguments(given).ok_or_else(|| self.wrong(column, mistake()))?;
            self.instructions.push(Instruction::Call(function));
            return Ok(());
        }
        let variable = Variable::ALL.iter().find(|(known, _)| *known == name).map(|&(_, v)| Instruction::Variable(v));
        let constant =
            CONSTANTS.iter().find(|(known, _)| *known == name).map(|&(_, number)| Instruction::Number(number));
        match variable.or(constant) {
            Some(_) if called => Err(self.wrong(column, Mistake::NotAFunction { name: name.to_string() })),
            Some(step) => {
                self.instructions.push(step);
                Ok(())
            }
            None => Err(self.wrong(column, Mistake::Name { name: name.to_string() })),
        }
    }

    /// Parses the arguments in brackets and returns their number.
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
